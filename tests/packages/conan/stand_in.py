# SPDX-License-Identifier: BSL-1.0
"""Runs the methods of the recipe where Conan itself is not installed, with what the recipe imports of
it replaced. PACKAGE then has the files that the package would have.

    stand_in.py RECIPE_DIR PACKAGE
"""

import fnmatch
import importlib.util
import pathlib
import re
import shutil
import sys
import tarfile
import types


class Options(dict):
    __getattr__ = dict.get
    get_safe = dict.get


class Info(types.SimpleNamespace):
    """What the package, or a component of it, says to those who use it."""

    def __init__(self):
        super().__init__(properties={}, requires=[])
        self.set_property = self.properties.__setitem__

    @property
    def components(self):
        return self.__dict__.setdefault("parts", {name: Info() for name in ("gnomon", "json")})


def copy(_, pattern, source, target):
    for file in pathlib.Path(source).rglob("*"):
        relative = file.relative_to(source)
        if file.is_file() and fnmatch.fnmatch(str(relative), pattern):
            (target / relative).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(file, target / relative)


def unzip(recipe, archive, strip_root):
    assert strip_root
    with tarfile.open(archive) as tar:
        for member in tar.getmembers():
            member.name = member.name.partition("/")[2]
            if member.name:
                tar.extract(member, recipe.source_folder)


def check_min_cppstd(recipe, standard):
    if int(recipe.settings["compiler.cppstd"]) < standard:
        raise ValueError


def import_recipe(folder):
    """The class of the recipe, with its modules of Conan."""
    names = {"conan": {"ConanFile": object},
             "conan.errors": {"ConanInvalidConfiguration": RuntimeError},
             "conan.tools": {},
             "conan.tools.build": {"check_min_cppstd": check_min_cppstd},
             "conan.tools.files": {"copy": copy, "get": None, "unzip": unzip},
             "conan.tools.layout": {"basic_layout": lambda *_, **__: None}}
    for name, members in names.items():
        sys.modules[name] = types.ModuleType(name)
        vars(sys.modules[name]).update(members)
    sys.dont_write_bytecode = True
    spec = importlib.util.spec_from_file_location("recipe", folder / "conanfile.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.GnomonConan


def main():
    folder, package = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    data = (folder / "conandata.yml").read_text(encoding="utf-8")
    recipe = import_recipe(folder)()
    recipe.conan_data = {"sources": {re.search(r'^  "(.*)":', data, re.M)[1]: {"releases": ""}}}
    recipe.version = None
    recipe.recipe_folder = str(folder)
    recipe.export_sources_folder = str(package) + "_export"
    recipe.source_folder = recipe.export_sources_folder + "/src"
    recipe.package_folder = str(package)
    recipe.settings = Options({"os": "Linux", "compiler.cppstd": "20"})
    recipe.options = Options(dict(recipe.default_options, json=True))
    recipe.cpp_info = Info()
    recipe.info = types.SimpleNamespace(clear=lambda: None)
    required = []
    recipe.requires = lambda name, **_: required.append(name)
    pathlib.Path(recipe.source_folder).mkdir(parents=True)

    for step in ("set_version", "export_sources", "layout", "requirements", "package_id", "validate",
                 "source", "package", "package_info"):
        getattr(recipe, step)()

    assert (package / "include/gnomon/gnomon.hpp").exists() and (package / "licenses/LICENSE").exists()
    assert [name.partition("/")[0] for name in required] == ["eigen", "nlohmann_json", "boost"]
    parts = recipe.cpp_info.components
    assert parts["gnomon"].properties["cmake_target_name"] == "gnomon::gnomon"
    assert parts["json"].requires == ["gnomon", "nlohmann_json::nlohmann_json"]
    recipe.settings["compiler.cppstd"] = "17"
    try:
        recipe.validate()
    except ValueError:
        return 0
    print("C++17 is not refused")
    return 1


if __name__ == "__main__":
    sys.exit(main())
