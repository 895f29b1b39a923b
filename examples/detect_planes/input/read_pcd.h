// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_READ_PCD_H
#define DETECT_PLANES_READ_PCD_H

#include "input/Byte_source.h"
#include "input/input_settings.h"
#include "input/point_set.h"

namespace program {

void read_pcd(Byte_source& file, const Input_settings& settings, Point_set& points);

} // namespace program

#endif // DETECT_PLANES_READ_PCD_H
