# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What is installed of TANDEM_BUILD: the program with the completion of its options and its page of the manual; and
other projects that use Tandem, through find_package after an installation or through add_subdirectory."""

import os
import re
import shutil
import subprocess

import pytest
from support import HELP, SOURCES, Program, table

BUILD = os.environ.get("TANDEM_BUILD")
pytestmark = pytest.mark.skipif(not BUILD, reason="TANDEM_BUILD is not set")
USES = os.environ.get("TANDEM_USES", "find_package add_subdirectory engine program").split()
FACTS = {name: os.environ.get(f"TANDEM_{name}", "") for name in ("CXX", "WITH_TBB", "HELP2MAN")}
CMAKE = ["cmake", f"-DCMAKE_CXX_COMPILER={FACTS['CXX'] or 'c++'}", f"-DTANDEM_WITH_TBB={FACTS['WITH_TBB'] or 'ON'}",
         "-DTANDEM_WITH_CUDA=OFF"]
VERSION = re.search(r'define CGAL_TANDEM_VERSION[^"]*"([0-9]+\.[0-9]+)',
                    (SOURCES / "include/CGAL/Shape_regularization_tandem/version.h").read_text()).group(1)
USER = r"""
#include <CGAL/Shape_regularization_tandem.h>
#include <CGAL/Simple_cartesian.h>
int main()
{
  using Point = CGAL::Simple_cartesian<double>::Point_3;
  std::vector<Point> points;
  for(int i = 0; i < 400; ++i)
    points.emplace_back(i % 20, i / 20, 0);
  try {
    const auto shapes = CGAL::Tandem::detect_planes<TAG>(points,
      CGAL::Tandem::parameters::maximum_distance(.1).minimum_region_size(100));
    return shapes.number_of_shapes() == 1 && shapes.coefficients(0)[2] * shapes.coefficients(0)[2] == 1 ? 0 : 1;
  } catch(const std::runtime_error& e) {
    return std::string(e.what()).find("no CUDA device") != std::string::npos ? 0 : 1;
  }
}
"""
FEW_HEADERS = """
#include <CGAL/Tandem/Parameters.h>
int main() { return int(CGAL::Tandem::Parameters().minimum_region_size); }
"""


def run(*command):
    result = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    assert result.returncode == 0, f"{command} ended with {result.returncode}:\n{result.stdout}"
    return result.stdout


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    if "program" not in USES:
        pytest.skip("the build does not have it")
    prefix = tmp_path_factory.mktemp("installed") / "usr"
    run("cmake", "--install", BUILD, "--prefix", prefix, "--component", "program")
    if FACTS["HELP2MAN"]:
        assert re.search("maximum.-distance", (prefix / "share/man/man1/detect_planes.1").read_text())
    return prefix


@pytest.mark.skipif(not shutil.which("bash"), reason="no bash")
@table("previous, word, found", [("cloud.ply", "--ang", "--angle-tolerance"), ("--backend", "s", "sequential"),
                                 ("cloud.ply", "--he", "--help"), ("--format", "la", "las" + " laz" * (".laz" in HELP)),
                                 ("detect_planes", "cloud", ""), ("--output-directory", "{}/us", "{}/usr")])
def test_completion(installed, previous, word, found):
    """What bash offers for the word after the previous one"""
    folder = str(installed.parent)
    offered = run("bash", "-c", '. "$1"; _detect_planes "$2" "$3" "$4"; echo ${COMPREPLY[*]}', "bash",
                  installed / "share/bash-completion/completions/detect_planes", installed / "bin/detect_planes",
                  word.format(folder), previous)
    assert offered.strip() == found.format(folder)


# Engines take long to compile, so each user has one: that of several threads where the installation has to find oneTBB.
# The rest of the headers is compiled by others than add_subdirectory.
@table("use, components, library", [
    ("find_package", "", "Tandem::tandem"), ("add_subdirectory", "", "Tandem::tandem"),
    ("engine", "COMPONENTS engine", "Tandem::tandem_engine"), ("cuda", "COMPONENTS cuda", "Tandem::tandem_cuda")])
def test_use(tmp_path, use, components, library):
    """A project of the user is configured, built and run. The engine and cuda are libraries that the build has."""
    prefix, build, user = tmp_path / "prefix", tmp_path / "build", Program(tmp_path / "user")
    if use not in USES:
        pytest.skip("the build does not have it")
    if use == "find_package":
        run(*CMAKE, "-S", SOURCES, "-B", tmp_path / "tandem", "-DTANDEM_BUILD_EXAMPLES=OFF", "-DTANDEM_BUILD_ENGINE=OFF",
            "-DTANDEM_BUILD_MODELS=OFF", "-DTANDEM_WITH_MPI=OFF", "-DTANDEM_BUILD_TESTS=OFF",
            f"-DCMAKE_INSTALL_PREFIX={prefix}")
        run("cmake", "--build", tmp_path / "tandem", "--target", "install")
    elif use != "add_subdirectory":
        run("cmake", "--install", BUILD, "--prefix", prefix)
    get = (f'add_subdirectory("{SOURCES}" tandem)' if use == "add_subdirectory" else
           f"find_package(Tandem {VERSION} REQUIRED {components})")
    tag = "CGAL::Tandem::Cuda_tag" if use == "cuda" else "CGAL::Parallel_if_available_tag"
    user.write({"user.cpp": FEW_HEADERS if use == "add_subdirectory" else USER.replace("TAG", tag),
                "CMakeLists.txt": f"cmake_minimum_required(VERSION 3.16)\nproject(user LANGUAGES CXX)\n{get}\n"
                                  f"add_executable(user user.cpp)\ntarget_link_libraries(user PRIVATE {library})\n"})
    run(*CMAKE, "-S", user.folder, "-B", build, f"-DCMAKE_PREFIX_PATH={prefix}", "-DCMAKE_BUILD_TYPE=Debug",
        "-DCMAKE_CXX_FLAGS_DEBUG=")
    run("cmake", "--build", build)
    run(build / "user")
