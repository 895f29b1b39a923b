// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "input/pcd_header.h"

#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>

namespace program {

namespace {

// What the lines say, before they are put together.
struct Lines {
  std::vector<std::string> names, types, viewpoint;
  std::vector<std::uint64_t> sizes, counts;
  std::map<std::string, std::uint64_t> numbers; // WIDTH, HEIGHT, POINTS

  std::uint64_t number(const std::string& key, std::uint64_t otherwise) const
  {
    const auto found = numbers.find(key);
    return found == numbers.end() ? otherwise : found->second;
  }
};

std::uint64_t parse_number_of(const std::string& key, const std::string& word)
{
  constexpr std::size_t most_digits = 15;
  if(word.empty() || word.size() > most_digits || word.find_first_not_of("0123456789") != word.npos)
    throw std::runtime_error("the PCD header has '" + word + "' where a number of " + key + " is expected");
  return std::stoull(word);
}

std::vector<std::string> words_of(std::istream& line)
{
  std::vector<std::string> words;
  for(std::string word; line >> word;)
    words.push_back(word);
  return words;
}

std::vector<std::uint64_t> parse_numbers(const std::string& key, std::istream& line)
{
  std::vector<std::uint64_t> numbers;
  for(const std::string& word : words_of(line))
    numbers.push_back(parse_number_of(key, word));
  return numbers;
}

std::uint64_t parse_one(const std::string& key, std::istream& line)
{
  const std::vector<std::uint64_t> numbers = parse_numbers(key, line);
  if(numbers.size() != 1)
    throw std::runtime_error("the PCD header has no number of " + key);
  return numbers[0];
}

void parse_line(const std::string& key, std::istream& line, Lines& lines)
{
  if(key == "FIELDS" || key == "COLUMNS")
    lines.names = words_of(line);
  else if(key == "SIZE")
    lines.sizes = parse_numbers(key, line);
  else if(key == "TYPE")
    lines.types = words_of(line);
  else if(key == "COUNT")
    lines.counts = parse_numbers(key, line);
  else if(key == "WIDTH" || key == "HEIGHT" || key == "POINTS")
    lines.numbers[key] = parse_one(key, line);
  else if(key == "VIEWPOINT")
    lines.viewpoint = words_of(line);
  else if(key != "VERSION")
    throw std::runtime_error("the PCD header has the unknown line '" + key.substr(0, 40) + "'");
}

Pcd_header::Field make_field(const Lines& lines, std::size_t i)
{
  Pcd_header::Field f;
  f.name = lines.names[i];
  f.size = std::size_t(lines.sizes[i]);
  f.type = lines.types[i][0];
  f.count = lines.counts.empty() ? 1 : std::size_t(lines.counts[i]);
  const bool is_integer = f.type == 'I' || f.type == 'U';
  const bool is_known = is_integer ? f.size == 1 || f.size == 2 || f.size == 4 || f.size == 8
                                   : f.type == 'F' && (f.size == 4 || f.size == 8);
  constexpr std::size_t most = 65536;
  if(!is_known || lines.types[i].size() != 1 || f.count > most)
    throw std::runtime_error("the PCD field '" + f.name + "' has the type " + lines.types[i] + " of " +
                             std::to_string(f.size) + " bytes, " + std::to_string(f.count) +
                             " times, expected I, U or F of 1, 2, 4 or 8 bytes");
  return f;
}

Pcd_header join(const Lines& lines)
{
  const std::size_t n = lines.names.size();
  if(n == 0 || lines.sizes.size() != n || lines.types.size() != n ||
     (!lines.counts.empty() && lines.counts.size() != n))
    throw std::runtime_error("the PCD header must have as many items in FIELDS, SIZE, TYPE and COUNT");
  Pcd_header header;
  header.viewpoint = lines.viewpoint;
  for(std::size_t i = 0; i < n; ++i) {
    Pcd_header::Field f = make_field(lines, i);
    f.position = header.row_size();
    f.first = header.row_values();
    header.fields.push_back(f);
  }
  const std::uint64_t width = lines.number("WIDTH", lines.number("POINTS", 0)), height = lines.number("HEIGHT", 1);
  if(height > 0 && width > (std::numeric_limits<std::uint64_t>::max)() / height)
    throw std::runtime_error("the PCD header has too large a WIDTH or HEIGHT");
  header.points = lines.number("POINTS", width * height);
  if(header.points != width * height)
    throw std::runtime_error("the PCD header has " + std::to_string(header.points) +
                             " POINTS, but WIDTH times HEIGHT is " + std::to_string(width * height));
  return header;
}

void check_coordinates(const Pcd_header& header)
{
  for(const char* name : {"x", "y", "z"})
    if(const Pcd_header::Field* f = header.find(name); f == nullptr || f->count != 1)
      throw std::runtime_error(std::string("the points of the PCD file have no field '") + name + "'");
}

} // namespace

Pcd_header read_pcd_header(Text_lines& text)
{
  Lines lines;
  while(text.next()) {
    std::istringstream line(text.row().text);
    std::string key;
    if(!(line >> key) || key[0] == '#')
      continue;
    if(key != "DATA") {
      parse_line(key, line, lines);
      continue;
    }
    Pcd_header header = join(lines);
    check_coordinates(header);
    line >> header.data;
    if(header.data != "ascii" && header.data != "binary" && header.data != "binary_compressed")
      throw std::runtime_error("unknown DATA '" + header.data + "' of PCD");
    return header;
  }
  throw std::runtime_error("is not a PCD file, or its header has no end (a line DATA)");
}

} // namespace program
