// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef DETECT_PLANES_EXTENSION_H
#define DETECT_PLANES_EXTENSION_H

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace program {

inline std::string lower_case_extension(const std::string& path)
{
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return extension;
}

} // namespace program

#endif // DETECT_PLANES_EXTENSION_H
