#!/bin/sh
# Copyright (c) 2026 The Tandem authors
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Says which tests notice each of the faults of test/Shape_regularization_tandem/seeded_faults.txt: seeded_faults.sh -h
# Whoever removes or joins tests runs it before and after.

exec python3 "$(dirname "$0")/seeded_faults.py" "$@"
