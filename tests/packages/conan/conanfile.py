# SPDX-License-Identifier: BSL-1.0
"""A library of the system in place of Conan's, so that the test needs no network:
    conan create conanfile.py --name eigen
"""

from conan import ConanFile

VERSIONS = {"boost": "1.74.0", "eigen": "3.4.0", "nlohmann_json": "3.11.2"}
CMAKE_NAMES = {"boost": ("Boost", "Boost::headers"), "eigen": ("Eigen3", "Eigen3::Eigen"),
               "nlohmann_json": ("nlohmann_json", "nlohmann_json::nlohmann_json")}


class LibraryOfTheSystem(ConanFile):
    package_type = "header-library"

    def set_version(self):
        self.version = VERSIONS[self.name]

    def package_id(self):
        self.info.clear()

    def package_info(self):
        file, target = CMAKE_NAMES[self.name]
        self.cpp_info.set_property("cmake_file_name", file)
        info = self.cpp_info.components["headers"] if self.name == "boost" else self.cpp_info
        info.includedirs = ["/usr/include/eigen3"] if self.name == "eigen" else []
        info.bindirs, info.libdirs = [], []
        info.set_property("cmake_target_name", target)
