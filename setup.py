# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the compiled part of the Python package tandem with CMake, without CUDA and MPI.

    TANDEM_CMAKE_ARGS    further options of CMake, such as -DCGAL_DIR=FOLDER
    TANDEM_PYTHON_BUILD  a build folder that has the compiled part, which is taken as it is
"""

import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import sysconfig

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent
CMAKE_ARGS = shlex.split(os.environ.get('TANDEM_CMAKE_ARGS', ''))
PACKAGES = {'cmake': 'cmake', 'make or ninja': 'make', 'a C++ compiler': 'g++', 'CGAL 5.5': 'libcgal-dev',
            'the headers of Python': 'python3-dev', 'pybind11 2.6': 'pybind11-dev'}


def version():
    text = (ROOT / 'include/CGAL/Shape_regularization_tandem/version.h').read_text(encoding='utf-8')
    return re.search('CGAL_TANDEM_VERSION "(.*)"', text).group(1)


def pybind11_folder():
    """The folder of its CMake files, if it is a package of this Python."""
    run = subprocess.run([sys.executable, '-m', 'pybind11', '--cmakedir'], capture_output=True, text=True, check=False)
    return run.stdout.strip() if run.returncode == 0 else None


def is_configured(name):
    return any(arg.startswith((f'-D{name}=', f'-D{name}:')) for arg in CMAKE_ARGS)


def has_header(header):
    """Whether it is where compilers, CMake and this Python look for it."""
    paths = sysconfig.get_paths()
    prefixes = [sys.prefix, '/usr/local', '/usr', *os.environ.get('CMAKE_PREFIX_PATH', '').split(os.pathsep)]
    folders = [paths['include'], paths['platinclude'], *os.environ.get('CPATH', '').split(os.pathsep),
               *(f'{prefix}/include' for prefix in prefixes if prefix)]
    return any((pathlib.Path(folder) / header).is_file() for folder in folders if folder)


def missing_parts():
    found = {'cmake': shutil.which('cmake'),
             'make or ninja': shutil.which('make') or shutil.which('ninja'),
             'a C++ compiler': any(map(shutil.which, [os.environ.get('CXX', 'c++').split()[0], 'g++', 'clang++'])),
             'CGAL 5.5': is_configured('CGAL_DIR') or is_configured('CMAKE_PREFIX_PATH') or has_header('CGAL/version.h'),
             'the headers of Python': has_header('Python.h'),
             'pybind11 2.6': is_configured('pybind11_DIR') or pybind11_folder() or has_header('pybind11/pybind11.h')}
    return [part for part, is_there in found.items() if not is_there]


def check_parts():
    """Ends the build with one message, if anything is missing."""
    missing = missing_parts()
    if missing:
        packages = ' '.join(PACKAGES[part] for part in missing)
        raise SystemExit(f'tandem cannot be built, these are missing: {", ".join(missing)}.\n'
                         f'On Debian and Ubuntu: sudo apt install {packages}')


class BuildWithCMake(build_ext):
    def build_extension(self, ext):
        built = os.environ.get('TANDEM_PYTHON_BUILD') or self.compile()
        name = pathlib.Path(self.get_ext_fullpath(ext.name))
        name.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(pathlib.Path(built) / 'python/tandem' / name.name, name)

    def compile(self):
        """Returns the build folder."""
        check_parts()
        folder = str(pathlib.Path(self.build_temp).resolve())
        options = ['-DCMAKE_BUILD_TYPE=Release', '-DTANDEM_BUILD_PYTHON=ON', f'-DPython3_EXECUTABLE={sys.executable}']
        options += [f'-DTANDEM_{part}=OFF' for part in ('WITH_CUDA', 'WITH_MPI', 'BUILD_EXAMPLES', 'BUILD_TESTS', 'INSTALL')]
        if pybind11_folder():
            options.append(f'-Dpybind11_DIR={pybind11_folder()}')
        jobs = os.environ.get('CMAKE_BUILD_PARALLEL_LEVEL', str(os.cpu_count() or 1))
        for command in (['cmake', '-S', str(ROOT), '-B', folder, *options, *CMAKE_ARGS],
                        ['cmake', '--build', folder, '--target', 'tandem_python', '--parallel', jobs]):
            if subprocess.run(command, check=False).returncode != 0:
                raise SystemExit(f'tandem cannot be built: {shlex.join(command)} has failed, see above')
        return folder


setup(version=version(), ext_modules=[Extension('tandem._tandem', sources=[])], cmdclass={'build_ext': BuildWithCMake})
