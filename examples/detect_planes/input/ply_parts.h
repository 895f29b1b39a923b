// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The header of a PLY file, and where its points and faces are: the file is read later, when it is known to be complete.

#ifndef DETECT_PLANES_INPUT_PLY_PARTS_H
#define DETECT_PLANES_INPUT_PLY_PARTS_H

#include "input/Input_buffer.h"

#include <cctype>
#include <istream>
#include <map>
#include <set>
#include <vector>

namespace program {

// --- Reads the header of a PLY file, and rejects unknown types and missing or repeated properties.

struct Ply_header {
  struct Property {
    std::string name, type;
    std::string count_type; // of a list, empty for a number

    bool is_list() const { return !count_type.empty(); }
  };
  struct Element {
    std::string name;
    std::uint64_t count = 0;
    std::vector<Property> properties;
  };
  std::string format;
  std::vector<Element> elements;

  bool is_ascii() const { return format == "ascii"; }
};

// Bytes of a scalar type of PLY, 0 if there is no such type.
inline std::uint64_t ply_type_size(const std::string& type)
{
  static const std::map<std::string, std::uint64_t> sizes = {
    {"char", 1},   {"int8", 1},    {"uchar", 1},  {"uint8", 1},  {"short", 2}, {"int16", 2},
    {"ushort", 2}, {"uint16", 2},  {"int", 4},    {"int32", 4},  {"uint", 4},  {"uint32", 4},
    {"float", 4},  {"float32", 4}, {"double", 8}, {"float64", 8}};
  const auto found = sizes.find(type);
  return found == sizes.end() ? 0 : found->second;
}

inline bool is_real_ply_type(const std::string& type) { return type[0] == 'f' || type[0] == 'd'; }

inline void parse_ply_format(const std::string& name, Ply_header& header)
{
  if(name != "ascii" && name != "binary_little_endian" && name != "binary_big_endian")
    throw_error("unknown format '", name, "' of PLY");
  header.format = name;
}

inline void parse_ply_element(std::istream& words, Ply_header& header)
{
  std::string name;
  std::int64_t count = -1;
  if(!(words >> name >> count) || count < 0)
    throw_error("the PLY header has no number of items for the element '", name, "'");
  header.elements.push_back({name, std::uint64_t(count), {}});
}

inline void parse_ply_property(std::istream& words, Ply_header& header)
{
  Ply_header::Property p;
  words >> p.type;
  if(p.type == "list")
    words >> p.count_type >> p.type;
  if(!(words >> p.name) || header.elements.empty())
    throw std::runtime_error("the PLY header has an incomplete property");
  for(const std::string& type : {p.type, p.is_list() ? p.count_type : p.type})
    if(ply_type_size(type) == 0)
      throw_error("unknown type '", type, "' of the PLY property '", p.name, "'");
  if(p.is_list() && is_real_ply_type(p.count_type))
    throw_error("the number of items of the PLY list '", p.name, "' must be an integer");
  header.elements.back().properties.push_back(p);
}

inline Ply_header read_ply_header(Text_lines& lines)
{
  constexpr std::size_t most_bytes = 1 << 20;
  Ply_header header;
  std::string keyword;
  if(!lines.next() || !(std::istringstream(lines.row().text) >> keyword) || keyword != "ply")
    throw std::runtime_error("is not a PLY file (the first line is not 'ply')");
  for(std::size_t bytes = 0; lines.next();) {
    bytes += lines.row().text.size() + 1;
    if(bytes > most_bytes)
      throw_error("the PLY header has more than ", most_bytes, " bytes, the limit");
    std::istringstream words(lines.row().text);
    if(!(words >> keyword))
      throw std::runtime_error("the PLY header has an empty line");
    if(header.format.empty() && keyword != "format")
      throw std::runtime_error("the second line of the PLY header is not its format");
    if(keyword == "format") {
      words >> keyword;
      parse_ply_format(keyword, header);
    } else if(keyword == "element") {
      parse_ply_element(words, header);
    } else if(keyword == "property") {
      parse_ply_property(words, header);
    } else if(keyword == "end_header") {
      return header;
    }
  }
  throw std::runtime_error("the PLY header has no end");
}

// The place of a number among the properties of an element, or their count: the one of that name, else the first one
// whose name differs by case.
inline std::size_t find_ply_number(const Ply_header::Element& element, const std::string& name)
{
  const auto find = [&](auto is_name) {
    const auto found = std::find_if(element.properties.begin(), element.properties.end(),
                                    [&](const auto& p) { return !p.is_list() && is_name(p.name); });
    return std::size_t(found - element.properties.begin());
  };
  const auto is_same = [&name](const std::string& other) {
    return std::equal(name.begin(), name.end(), other.begin(), other.end(),
                      [](unsigned char a, unsigned char b) { return a == std::tolower(b); });
  };
  const std::size_t exact = find([&name](const std::string& other) { return other == name; });
  return exact < element.properties.size() ? exact : find(is_same);
}

inline void check_ply_points(const Ply_header::Element& points)
{
  std::set<std::string> names;
  for(const Ply_header::Property& p : points.properties)
    if(!names.insert(p.name).second)
      throw_error("the points of the PLY file have two properties '", p.name, "'");
  for(const char* name : {"x", "y", "z"})
    if(find_ply_number(points, name) == points.properties.size())
      throw_error("the points of the PLY file have no property '", name, "'");
}

// --- Finds the points in a PLY file, and checks that the file has what its header says.

// The least number of bytes that an item of the element takes.
inline std::uint64_t least_item_size(const Ply_header::Element& element, bool is_ascii)
{
  std::uint64_t bytes = 0;
  for(const Ply_header::Property& p : element.properties)
    bytes += is_ascii ? 2 : ply_type_size(p.is_list() ? p.count_type : p.type);
  return bytes;
}

inline bool has_list(const Ply_header::Element& element)
{
  return std::any_of(element.properties.begin(), element.properties.end(), [](const auto& p) { return p.is_list(); });
}

inline std::uint64_t largest_value(const std::string& integer_type)
{
  const std::uint64_t bits = 8 * ply_type_size(integer_type) - (integer_type[0] == 'u' ? 0 : 1);
  return (std::uint64_t(1) << bits) - 1;
}

inline void skip_blanks_of(std::streambuf& in)
{
  for(int c = in.sgetc(); is_blank(c); c = in.snextc())
    ;
}

// Goes through the elements without storing them. Memory is not needed before the file is known to be complete.
class Ply_scanner {
public:
  Ply_scanner(Input_buffer& in, const Ply_header& header) : in(in), header(header) {}

  // `are_points`: each row is stored later, so that it has a limit, as the lines of other texts have.
  void skip(const Ply_header::Element& element, bool are_points)
  {
    is_limited = are_points;
    const std::uint64_t item = least_item_size(element, header.is_ascii());
    if(item == 0)
      return;
    // The last row of a text need not have an end.
    const std::uint64_t room = (in.left() + (header.is_ascii() ? 1 : 0)) / item;
    if(element.count > room)
      throw_error("is truncated: ", element.count, " items of '", element.name, "' announced, room for ", room,
                  " at most");
    if(!header.is_ascii() && !has_list(element)) {
      in.skip(item * element.count);
      return;
    }
    for(row = 1; row <= element.count; ++row)
      skip_row(element);
  }

  void check_end()
  {
    if(header.is_ascii() || in.left() <= 2) // some programs end binary files with a new line, too
      skip_blanks_of(in);
    if(in.left() > 0)
      throw_error("is longer than its header says: ", in.left(),
                  " bytes follow the last element (correct the numbers of items in the header, or add "
                  "the property that is missing there)");
  }

private:
  void skip_row(const Ply_header::Element& element)
  {
    for(const Ply_header::Property& p : element.properties) {
      const std::uint64_t count = p.is_list() ? read_count(element, p) : 1;
      if(header.is_ascii())
        skip_words(element, count);
      else
        skip_bytes(element, count * ply_type_size(p.type));
    }
    if(header.is_ascii() && !is_end_of_line(element))
      throw_error(place(element), " has more values than the header says (add the property that is "
                                  "missing there)");
  }

  std::uint64_t read_count(const Ply_header::Element& element, const Ply_header::Property& p)
  {
    const std::uint64_t count = header.is_ascii() ? read_text_count(element) : read_binary_count(element, p);
    const std::uint64_t room = header.is_ascii() ? in.left() / 2 + 1 : in.left() / ply_type_size(p.type);
    if(count > largest_value(p.count_type) || count > room)
      throw_error(place(element), " has ", count, " items in the list '", p.name, "', room for ",
                  (std::min)(room, largest_value(p.count_type)), " at most");
    return count;
  }

  std::uint64_t read_text_count(const Ply_header::Element& element)
  {
    skip_blanks(element);
    std::string word;
    for(int c = in.sgetc(); word.size() < 20 && c != eof && !is_blank(c); c = next_byte(element))
      word += char(c);
    std::uint64_t count = 0;
    const auto end = std::from_chars(word.data(), word.data() + word.size(), count);
    if(word.empty() || end.ec != std::errc() || end.ptr != word.data() + word.size())
      throw_error(place(element), " has '", word, "' where the number of items of a list is expected");
    return count;
  }

  std::uint64_t read_binary_count(const Ply_header::Element& element, const Ply_header::Property& p)
  {
    const std::uint64_t bytes = ply_type_size(p.count_type);
    check_left(element, bytes);
    std::uint64_t count = 0;
    for(std::uint64_t i = 0; i < bytes; ++i) {
      const std::uint64_t byte = std::uint64_t(in.sbumpc() & 255);
      count |= byte << 8 * (header.format == "binary_big_endian" ? bytes - 1 - i : i);
    }
    return count;
  }

  void skip_words(const Ply_header::Element& element, std::uint64_t count)
  {
    for(; count > 0; --count) {
      length = is_limited ? length : 0;
      skip_blanks(element);
      check_left(element, 1);
      for(int c = in.sgetc(); c != eof && !is_blank(c); c = next_byte(element))
        if(c == ',')
          throw_error(place(element), " has a comma (write numbers with a decimal point, and blanks "
                                      "between them)");
    }
  }

  // Passes over the byte at hand, and returns the one behind it.
  int next_byte(const Ply_header::Element& element)
  {
    const int before = in.sgetc(), c = in.snextc();
    length = before == '\n' ? 0 : length + 1;
    if(before == '\r' && c != '\r' && c != '\n' && c != eof)
      throw_error(place(element), ' ', carriage_return_alone);
    if(length > longest_line)
      throw_error(place(element), " has more than ", longest_line, " bytes, the limit of a ",
                  (is_limited ? "line" : "number"));
    return c;
  }

  void skip_blanks(const Ply_header::Element& element)
  {
    for(int c = in.sgetc(); is_blank(c); c = next_byte(element))
      ;
  }

  void skip_bytes(const Ply_header::Element& element, std::uint64_t count)
  {
    check_left(element, count);
    in.skip(count);
  }

  bool is_end_of_line(const Ply_header::Element& element)
  {
    int c = in.sgetc();
    while(c != '\n' && is_blank(c))
      c = next_byte(element);
    return c == '\n' || c == eof;
  }

  void check_left(const Ply_header::Element& element, std::uint64_t bytes) const
  {
    check_signals();
    if(bytes > in.left())
      throw_error("is truncated: ", place(element), " of ", element.count, " is not complete");
  }

  std::string place(const Ply_header::Element& element) const
  {
    return "row " + std::to_string(row) + " of '" + element.name + "'";
  }

  static constexpr int eof = std::streambuf::traits_type::eof();
  Input_buffer& in;
  const Ply_header& header;
  std::uint64_t row = 0;
  std::size_t length = 0; // of the line, or of the number, as far as it is read
  bool is_limited = true;
};

// An element, and where its rows are.
struct Ply_part {
  Ply_header::Element element;
  Byte_range bytes;
};

// What there is to read of a file.
struct Ply_parts {
  std::string format;
  Ply_part points;
  std::vector<Ply_part> faces;
};

inline Ply_parts find_ply_parts(Byte_source& file)
{
  Input_buffer in(file);
  Text_lines lines(in);
  const Ply_header header = read_ply_header(lines);
  Ply_scanner scanner(in, header);
  Ply_parts parts = {header.format, {}, {}};
  bool has_points = false;
  for(const Ply_header::Element& element : header.elements) {
    const bool is_points = element.name == "vertex" || element.name == "vertices";
    if(is_points && has_points)
      throw std::runtime_error("the PLY file has two elements of points");
    if(is_points)
      check_ply_points(element);
    const std::uint64_t first = in.position();
    scanner.skip(element, is_points);
    if(is_points)
      parts.points = {element, {first, in.position()}};
    has_points = has_points || is_points;
    if(element.count > 0 && (element.name == "face" || element.name == "faces" || element.name == "tristrips"))
      parts.faces.push_back({element, {first, in.position()}});
  }
  if(!has_points)
    throw std::runtime_error("the PLY file has no element 'vertex'");
  scanner.check_end();
  return parts;
}

} // namespace program

#endif // DETECT_PLANES_INPUT_PLY_PARTS_H
