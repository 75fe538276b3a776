# SPDX-License-Identifier: BSL-1.0
"""The source is, in this sequence: the tree that this recipe is in, the tarball of the release next to
this file, or that tarball at the public address of conandata.yml."""

import os
import shutil

from conan import ConanFile
from conan.errors import ConanInvalidConfiguration
from conan.tools.build import check_min_cppstd
from conan.tools.files import copy, get, unzip
from conan.tools.layout import basic_layout

required_conan_version = ">=2.0"


class GnomonConan(ConanFile):
    name = "gnomon"
    description = "Generic algorithms that turn range scans into normals, surfaces, parts and objects."
    license = "BSL-1.0"
    homepage = None
    topics = ("point-cloud", "lidar", "normals", "segmentation", "header-only")
    package_type = "header-library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"assimp": [True, False], "embree": [True, False], "json": [True, False],
               "recognition": [True, False]}
    default_options = {"assimp": False, "embree": False, "json": False, "recognition": False}
    no_copy_source = True

    def set_version(self):
        self.version = self.version or next(iter(self.conan_data["sources"]))

    def export_sources(self):
        tree = os.path.join(self.recipe_folder, "..", "..")
        if os.path.exists(os.path.join(tree, "include", "gnomon", "version.hpp")):
            copy(self, "*.hpp", os.path.join(tree, "include"),
                 os.path.join(self.export_sources_folder, "include"))
            shutil.copy(os.path.join(tree, "LICENSE"), self.export_sources_folder)
        else:
            copy(self, self._tarball, self.recipe_folder, self.export_sources_folder)

    @property
    def _tarball(self):
        return f"gnomon-{self.version}.tar.gz"

    @property
    def _with_boost(self):  # for Hana, which models in JSON need as recognition does
        return self.options.recognition or self.options.json

    def layout(self):
        basic_layout(self, src_folder="src")

    def requirements(self):
        self.requires("eigen/[>=3.4.0 <6]", transitive_headers=True)
        if self.options.assimp:
            self.requires("assimp/[>=5.2 <6]", transitive_headers=True, transitive_libs=True)
        if self.options.embree:
            self.requires("embree/[>=4.0 <5]", transitive_headers=True, transitive_libs=True)
        if self.options.json:
            self.requires("nlohmann_json/[>=3.10 <4]", transitive_headers=True)
        if self._with_boost:
            self.requires("boost/[>=1.74 <2]", transitive_headers=True)

    def package_id(self):
        self.info.clear()

    def validate(self):
        if self.settings.get_safe("compiler.cppstd"):
            check_min_cppstd(self, 20)

    def source(self):
        base = self.export_sources_folder
        if os.path.exists(os.path.join(base, "include")):
            return
        if os.path.exists(os.path.join(base, self._tarball)):
            unzip(self, os.path.join(base, self._tarball), strip_root=True)
            return
        source = self.conan_data["sources"][self.version]
        if not source["releases"]:
            raise ConanInvalidConfiguration(
                f"gnomon has no public address yet: put {self._tarball} next to conanfile.py")
        get(self, f"{source['releases']}/{self.version}/{self._tarball}", sha256=source["sha256"],
            strip_root=True)

    def package(self):
        base = self.source_folder
        if not os.path.exists(os.path.join(base, "include")):
            base = self.export_sources_folder
        copy(self, "*.hpp", os.path.join(base, "include"), os.path.join(self.package_folder, "include"))
        copy(self, "LICENSE", base, os.path.join(self.package_folder, "licenses"))

    def package_info(self):
        self.cpp_info.set_property("cmake_file_name", "gnomon")
        adapters = {"assimp": "assimp::assimp", "embree": "embree::embree",
                    "json": "nlohmann_json::nlohmann_json"}
        adapters = {name: needed for name, needed in adapters.items() if self.options.get_safe(name)}
        core = self.cpp_info
        if adapters:  # gnomon::gnomon is the same with and without them
            self.cpp_info.set_property("cmake_target_name", "gnomon::all")
            self.cpp_info.set_property("pkg_config_name", "gnomon-all")
            core = self.cpp_info.components["gnomon"]
        core.set_property("cmake_target_name", "gnomon::gnomon")
        core.set_property("pkg_config_name", "gnomon")
        core.bindirs, core.libdirs = [], []
        core.requires = ["eigen::eigen"] + (["boost::headers"] if self._with_boost else [])
        if self.settings.os in ("Linux", "FreeBSD"):
            core.system_libs = ["pthread", "m"]
        for name, needed in adapters.items():
            adapter = self.cpp_info.components[name]
            adapter.set_property("cmake_target_name", f"gnomon::{name}")
            adapter.bindirs, adapter.libdirs, adapter.includedirs = [], [], []
            adapter.requires = ["gnomon", needed]
