"""Untried. The libraries and tools by Conan 2, from the clone in which this file is."""
import os

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain
from conan.tools.files import copy


class Mesher(ConanFile):
    name = "mesher"
    version = "0.2.0"
    license = "MIT"
    description = "Quality Delaunay meshes that follow edits of their input"
    settings = "os", "arch", "compiler", "build_type"
    package_type = "static-library"
    requires = ("cli11/2.3.2", "nlohmann_json/3.11.2", "tsl-robin-map/1.2.1", "zlib/1.2.13",
                "boost/1.81.0")
    default_options = {"boost/*:header_only": True}

    def export_sources(self):
        root = os.path.join(self.recipe_folder, "..", "..", "..")
        for pattern in ("CMakeLists.txt", "LICENSE", "sac/*", "mesher/*", "traces/*", "tests/*"):
            copy(self, pattern, src=root, dst=self.export_sources_folder)

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.variables["BUILD_TESTING"] = False
        toolchain.generate()
        CMakeDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", src=self.source_folder, dst=os.path.join(self.package_folder,
                                                                       "licenses"))
        CMake(self).install()

    def package_info(self):
        for name, depends in (("sac", []), ("mesher", ["sac", "zlib::zlib"]),
                              ("traces", ["sac"])):
            part = self.cpp_info.components[name]
            part.libs = [name]
            part.requires = depends
            part.cxxflags = ["-ffp-contract=off"]
            part.set_property("cmake_file_name", name)
            part.set_property("cmake_target_name", f"{name}::{name}")
