// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "input/readers.h"

#include <boost/algorithm/string/predicate.hpp>

#include <map>
#include <set>

namespace program {

namespace {

// --- Reads the header of a PLY file, and rejects unknown types and missing or repeated properties.

// The kind is that of number_of_type().
struct Type {
  char kind = 0;
  std::size_t size = 0; // 0 if there is no such type

  // Of an integer type.
  std::uint64_t largest() const { return (std::uint64_t(1) << (8 * size - (kind == 'U' ? 0 : 1))) - 1; }
};

Type type_of(const std::string& name)
{
  static const std::map<std::string, Type> types = {
    {"char", {'I', 1}},  {"int8", {'I', 1}},    {"uchar", {'U', 1}},  {"uint8", {'U', 1}},
    {"short", {'I', 2}}, {"int16", {'I', 2}},   {"ushort", {'U', 2}}, {"uint16", {'U', 2}},
    {"int", {'I', 4}},   {"int32", {'I', 4}},   {"uint", {'U', 4}},   {"uint32", {'U', 4}},
    {"float", {'F', 4}}, {"float32", {'F', 4}}, {"double", {'F', 8}}, {"float64", {'F', 8}}};
  const auto found = types.find(name);
  return found == types.end() ? Type() : found->second;
}

struct Property {
  std::string name;
  Type type;
  std::optional<Type> count; // of a list
  std::size_t line = 0;      // of the element
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
  std::vector<std::string> lines; // behind its own: properties and comments

  bool has_points() const { return is_in(name, {"vertex", "vertices"}); }
  bool has_faces() const { return count > 0 && is_in(name, {"face", "faces", "tristrips"}); }
};

struct Header {
  std::string format;
  std::vector<std::string> lines; // before the elements
  std::vector<Element> elements;
};

Property parse_property(std::istream& words)
{
  std::string name, type, count;
  words >> type;
  if(type == "list")
    words >> count >> type;
  if(!(words >> name))
    throw std::runtime_error("the PLY header has an incomplete property");
  for(const std::string& word : {type, count.empty() ? type : count})
    if(type_of(word).size == 0)
      throw_error("unknown type '", word, "' of the PLY property '", name, "'");
  if(count.empty())
    return {name, type_of(type), std::nullopt, 0};
  if(type_of(count).kind == 'F')
    throw_error("the number of items of the PLY list '", name, "' must be an integer");
  return {name, type_of(type), type_of(count), 0};
}

Header read_header(Text_lines& lines)
{
  constexpr std::size_t most_bytes = 1 << 20;
  Header header;
  std::string keyword;
  if(!lines.next() || !(std::istringstream(lines.row().text) >> keyword) || keyword != "ply")
    throw std::runtime_error("is not a PLY file (the first line is not 'ply')");
  header.lines.push_back(lines.row().text);
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
      words >> header.format;
      if(!is_in(header.format, {"ascii", "binary_little_endian", "binary_big_endian"}))
        throw_error("unknown format '", header.format, "' of PLY");
    } else if(keyword == "element") {
      std::string name;
      std::int64_t count = -1;
      if(!(words >> name >> count) || count < 0)
        throw_error("the PLY header has no number of items for the element '", name, "'");
      header.elements.push_back({name, std::uint64_t(count), {}, {}});
      continue;
    } else if(keyword == "property") {
      if(header.elements.empty())
        throw std::runtime_error("the PLY header has an incomplete property");
      header.elements.back().properties.push_back(parse_property(words));
      header.elements.back().properties.back().line = header.elements.back().lines.size();
    } else if(keyword == "end_header") {
      return header;
    }
    (header.elements.empty() ? header.lines : header.elements.back().lines).push_back(lines.row().text);
  }
  throw std::runtime_error("the PLY header has no end");
}

// The place of a number among the properties of an element, or `nowhere`: the one of that name, else the first one whose
// name differs by case.
std::size_t find_number(const Element& element, const std::string& name)
{
  for(bool is_exact : {true, false})
    for(std::size_t i = 0; i < element.properties.size(); ++i)
      if(const Property& p = element.properties[i];
         !p.count && (is_exact ? p.name == name : boost::iequals(p.name, name, std::locale::classic())))
        return i;
  return nowhere;
}

// The element of the points.
const Element& points_of(const Header& header)
{
  const Element* points = nullptr;
  for(const Element& element : header.elements)
    if(element.has_points() && std::exchange(points, &element) != nullptr)
      throw std::runtime_error("the PLY file has two elements of points");
  if(points == nullptr)
    throw std::runtime_error("the PLY file has no element 'vertex'");
  std::set<std::string> names;
  for(const Property& p : points->properties)
    if(!names.insert(p.name).second)
      throw_error("the points of the PLY file have two properties '", p.name, "'");
  for(const char* name : {"x", "y", "z"})
    if(find_number(*points, name) == nowhere)
      throw_error("the points of the PLY file have no property '", name, "'");
  return *points;
}

// --- Reads the rows of the elements, and finds what is not as the header says.

// A real number of a text, as a stream reads it: one that is too small becomes 0, a float is rounded once.
template <class Real>
bool parse_real(std::string_view word, double& x)
{
  Real real = 0;
  if(word.size() > 1 && word.front() == '+' && word[1] != '-')
    word.remove_prefix(1);
  const auto end = std::from_chars(word.data(), word.data() + word.size(), real);
  bool is_right = !word.empty() && end.ptr == word.data() + word.size();
  if(is_right && end.ec != std::errc()) {
    std::istringstream in{std::string(word)};
    in.imbue(std::locale::classic());
    is_right = bool(in >> real);
  }
  x = double(real);
  return is_right;
}

bool parse_integer(std::string_view word, const Type& type, double& x)
{
  if(word.size() > 1 && word[0] == '+' && is_digit(word[1]))
    word.remove_prefix(1);
  std::int64_t integer = 0;
  const auto end = std::from_chars(word.data(), word.data() + word.size(), integer);
  x = double(integer);
  const auto largest = std::int64_t(type.largest());
  return end.ec == std::errc() && end.ptr == word.data() + word.size() && integer <= largest &&
         integer >= (type.kind == 'U' ? 0 : -largest - 1);
}

// Goes through the rows of an element, from the one on where the buffer stands.
class Rows {
public:
  Rows(Input_buffer& in, const std::string& format, const Element& element)
    : in(in), element(element), is_ascii(format == "ascii"), is_big(format == "binary_big_endian")
  {
    for(const Property& p : element.properties) {
      least_size += is_ascii ? 2 : p.count.value_or(p.type).size;
      have_one_size = have_one_size && !is_ascii && !p.count;
    }
    if(least_size == 0)
      return;
    // The last row of a text need not have an end.
    const std::uint64_t room = (in.left() + (is_ascii ? 1 : 0)) / least_size;
    if(element.count > room)
      throw_error("is truncated: ", element.count, " items of '", element.name,
                  "' announced, but the file has room for ", room, " at most");
  }

  // Passes over all of them.
  void skip()
  {
    if(have_one_size)
      in.skip(least_size * element.count);
    else
      while(least_size > 0 && row < element.count)
        next(nowhere, false);
  }

  // Reads the numbers of the next row, and the items of one list, if they are wanted.
  void next(std::size_t wanted_list = nowhere, bool is_wanted = true)
  {
    ++row;
    record.clear();
    numbers.resize(element.properties.size());
    for(std::size_t i = 0; i < numbers.size(); ++i) {
      const Property& p = element.properties[i];
      is_kept = i < kept.size() && kept[i];
      const std::uint64_t count = p.count ? read_count(p) : 1;
      if(!is_ascii && !is_wanted) {
        check_left(count * p.type.size);
        in.skip(count * p.type.size);
        continue;
      }
      if(i == wanted_list)
        list.resize(std::size_t(count));
      for(std::uint64_t k = 0; k < count; ++k) {
        numbers[i] = is_ascii ? read_word(p, is_wanted) : read_bytes(p.type);
        if(i == wanted_list)
          list[std::size_t(k)] = numbers[i];
      }
      if(p.count)
        numbers[i] = double(count);
    }
    if(is_ascii && !is_end_of_line())
      throw_error(place(), " has more values than the header says (add the missing property to the header)");
  }

  std::vector<double> numbers; // one of each property: of a list that of its items
  std::vector<double> list;    // the items of the wanted one
  std::vector<bool> kept;      // the properties that the record has
  std::string record;          // the bytes of the row; of a text its values, with end_of_value behind each

private:
  std::uint64_t read_count(const Property& p)
  {
    std::uint64_t count = 0;
    if(is_ascii) {
      read_word(20);
      const auto end = std::from_chars(word.data(), word.data() + word.size(), count);
      if(word.empty() || end.ec != std::errc() || end.ptr != word.data() + word.size())
        throw_error(place(), " has '", word, "' where the number of items of a list is expected");
    } else {
      count = std::uint64_t(read_bytes({'U', p.count->size}));
    }
    const std::uint64_t room = is_ascii ? in.left() / 2 + 1 : in.left() / p.type.size;
    if(count > p.count->largest() || count > room)
      throw_error(place(), " has ", count, " items in the list '", p.name, "', but there is room for ",
                  (std::min)(room, p.count->largest()), " at most");
    return count;
  }

  double read_bytes(const Type& type)
  {
    char bytes[8];
    check_left(type.size);
    if(in.sgetn(bytes, std::streamsize(type.size)) != std::streamsize(type.size))
      fail("");
    if(is_kept)
      record.append(bytes, type.size);
    if(is_big)
      std::reverse(bytes, bytes + type.size);
    return number_of_type(bytes, type.kind, type.size);
  }

  // The bytes up to the next blank.
  void read_word(std::size_t most)
  {
    length = element.has_points() ? length : 0;
    word.clear();
    for(int c = in.sgetc(); is_blank(c); c = next_byte())
      ;
    for(int c = in.sgetc(); word.size() < most && c != eof && !is_blank(c); c = next_byte())
      word += char(c);
    if(is_kept)
      (record += word) += end_of_value;
  }

  // 0 if it is not wanted.
  double read_word(const Property& p, bool is_wanted)
  {
    read_word(std::string::npos);
    if(word.empty())
      check_left(1);
    if(word.find(',') != word.npos)
      throw_error(place(), " has a comma (write numbers with a decimal point, and blanks between them)");
    double x = 0;
    if(is_wanted && !(p.type.kind != 'F' ? parse_integer(word, p.type, x)
                      : p.type.size == 8 ? parse_real<double>(word, x)
                                         : parse_real<float>(word, x)))
      fail(" (a value is not of the type that the header says: '" + word.substr(0, 40) + "' of the property '" +
           p.name + "')");
    return x;
  }

  // Passes over the byte at hand, and returns the one behind it. Each row of a point has a limit, as the lines of other
  // texts have.
  int next_byte()
  {
    const int before = in.sgetc(), c = in.snextc();
    length = before == '\n' ? 0 : length + 1;
    if(before == '\r' && c != '\r' && c != '\n' && c != eof)
      throw_error(place(), ' ', carriage_return_alone);
    if(length > longest_line)
      throw_error(place(), " has more than ", longest_line, " bytes, the limit of a ",
                  (element.has_points() ? "line" : "number"));
    return c;
  }

  bool is_end_of_line()
  {
    int c = in.sgetc();
    while(c != '\n' && is_blank(c))
      c = next_byte();
    return c == '\n' || c == eof;
  }

  void check_left(std::uint64_t bytes) const
  {
    check_signals();
    if(bytes > in.left())
      throw_error("is truncated: ", place(), " of ", element.count, " is not complete");
  }

  [[noreturn]] void fail(const std::string& reason) const
  {
    check_signals();
    throw_error("unreadable after ", element.name == "face" ? "face " : "point ", row - 1, " of ", element.count,
                reason);
  }

  std::string place() const { return "row " + std::to_string(row) + " of '" + element.name + "'"; }

  static constexpr int eof = std::streambuf::traits_type::eof();
  Input_buffer& in;
  const Element& element;
  bool is_ascii, is_big, have_one_size = true, is_kept = false;
  std::uint64_t least_size = 0; // of a row
  std::uint64_t row = 0;        // from 1 on
  std::size_t length = 0;       // of the line, or of the number, as far as it is read
  std::string word;
};

// Behind the last element.
void check_end(Input_buffer& in, bool is_ascii)
{
  if(is_ascii || in.left() <= 2) // some programs end binary files with a new line, too
    while(is_blank(in.sgetc()))
      in.sbumpc();
  if(in.left() > 0)
    throw_error("is longer than its header says: ", in.left(),
                " bytes follow the last element (correct the numbers of items in the header, or add the missing "
                "property)");
}

// ---

std::string joined_lines(const std::vector<std::string>& lines)
{
  std::string text;
  for(const std::string& line : lines)
    text += line.empty() ? "" : line + '\n';
  return text;
}

// A part of a file; of a text without blanks around it, but with the end of its last line.
std::string bytes_of(Byte_source& file, std::uint64_t first, std::uint64_t last, bool is_text)
{
  std::string bytes(std::size_t(last - first), '\0');
  Input_buffer(file, first).sgetn(bytes.data(), std::streamsize(bytes.size()));
  check_signals();
  if(is_text) {
    bytes.erase(0, first_not_blank(bytes));
    while(!bytes.empty() && is_blank(bytes.back()))
      bytes.pop_back();
    bytes += bytes.empty() ? "" : "\n";
  }
  return bytes;
}

// The property that has each of the columns.
Column_places places_of_columns(const Element& points, const std::string& tolerance)
{
  Column_places places;
  places.fill(nowhere);
  for(std::size_t c = 0; c < std::size_t(Column::red); ++c)
    places[c] = find_number(points, name_of(Column(c)));
  std::vector<std::string> names; // of those that are neither coordinates nor normals
  for(std::size_t i = 0; i < points.properties.size(); ++i) {
    const bool is_other = !points.properties[i].count && std::find(places.begin(), places.end(), i) == places.end();
    names.push_back(is_other ? points.properties[i].name : "");
  }
  for(std::size_t i = 0; i < names.size(); ++i)
    if(const Column c = column_of_name(names[i]);
       c >= Column::red && c != Column::none && places[std::size_t(c)] == nowhere)
      places[std::size_t(c)] = i;
  if(!tolerance.empty())
    places[std::size_t(Column::tolerance)] = find_name(names, tolerance, "property");
  return places;
}

// The properties that the records of points have.
std::vector<bool> kept_properties(const Element& points, const Column_places& places, const Input_settings& settings,
                                  Input_notes& notes)
{
  Input_records& records = *notes.records;
  const Type& type = points.properties[places[0]].type;
  records.real_size = type.kind == 'F' ? type.size : 4;
  std::vector<bool> kept;
  std::vector<std::string> lines = points.lines;
  for(std::size_t i = 0; i < points.properties.size(); ++i) {
    const Property& p = points.properties[i];
    kept.push_back(keeps_field(p.name, column_at(places, i), settings, notes));
    if(kept.back())
      records.layout += lines[p.line] + '\n';
    else
      lines[p.line].clear();
  }
  records.head = {"", joined_lines(lines), ""};
  return kept;
}

// What is around the points. Other elements may name points by their places: they go where points are left out.
void describe_records(Byte_source& file, const Header& header, const std::vector<std::uint64_t>& places,
                      Input_notes& notes)
{
  Input_records& records = *notes.records;
  const bool is_text = header.format == "ascii";
  records.encoding = is_text                                ? Encoding::text
                     : header.format == "binary_big_endian" ? Encoding::big_endian
                                                            : Encoding::little_endian;
  records.layout += header.format;
  const auto has_points = [](const Element& element) { return element.has_points(); };
  const auto points = std::find_if(header.elements.begin(), header.elements.end(), has_points);
  const bool has_others = std::any_of(header.elements.begin(), header.elements.end(), [](const Element& element) {
    return !element.has_points() && element.count > 0;
  });
  const bool has_all = records.ends.size() == points->count;
  records.is_whole = has_others && has_all;
  records.has_others = records.has_others || records.is_whole;
  records.head[0] = joined_lines(header.lines);
  std::string bytes_before;
  for(std::size_t e = 0; e < header.elements.size() && (has_all || !has_others); ++e) {
    const Element& element = header.elements[e];
    if(element.has_points())
      continue;
    const bool is_before = &element < &*points;
    records.head[is_before ? 0 : 2] +=
      text_of("element ", element.name, ' ', element.count, '\n', joined_lines(element.lines));
    if(element.count > 0)
      (is_before ? bytes_before : records.tail) += bytes_of(file, places[e], places[e + 1], is_text);
  }
  records.head[0] += "element " + points->name + ' ';
  records.head[2] += "end_header\n" + bytes_before;
  if(has_others && !has_all)
    notes.warnings.emplace_back("has more than points, which the output does not have, because points are left out");
}

// Colors have channels of 8 bits, of 16 bits, or real ones from 0 to 1: all points tell which.
void read_points(Rows& rows, const Element& element, const Input_settings& settings, Point_set& points,
                 Input_notes& notes)
{
  const Column_places places = places_of_columns(element, settings.tolerance);
  Cloud_builder builder(points, fields_of(places, settings, "property"), settings, notes);
  const bool has_color = points.has_property_map<Input_color>(color_name);
  if(notes.records)
    rows.kept = kept_properties(element, places, settings, notes);
  std::vector<double> channels;
  double largest = 0;
  bool are_integers = true;
  for(std::uint64_t i = 0; i < element.count; ++i) {
    rows.next();
    const Row_values values = values_at(places, [&](std::size_t property) { return rows.numbers[property]; });
    const bool is_kept = builder.add(row_of(values));
    if(is_kept && notes.records)
      notes.records->add(rows.record);
    for(std::size_t c = std::size_t(Column::red); has_color && c <= std::size_t(Column::blue); ++c) {
      largest = (std::max)(largest, values[c]);
      are_integers = are_integers && values[c] == std::floor(values[c]);
      if(is_kept)
        channels.push_back(values[c]);
    }
  }
  const double unit = !are_integers && largest <= 1 ? 65535 : largest <= 255 ? 257 : 1;
  if(has_color)
    builder.set_colors([&, next = channels.begin()]() mutable { return clamped<std::uint16_t>(unit * *next++); });
}

void add_faces(Rows& rows, const Element& element, Mesh_faces& faces)
{
  const auto are_corners = [](const Property& p) {
    return p.count && is_in(p.name, {"vertex_indices", "vertex_index"});
  };
  const auto corners = std::find_if(element.properties.begin(), element.properties.end(), are_corners);
  if(element.name == "tristrips" || corners == element.properties.end())
    throw_error("has '", element.name, "' without the corners of single faces; --sample 0 uses its points");
  for(std::uint64_t i = 0; i < element.count; ++i) {
    rows.next(std::size_t(corners - element.properties.begin()));
    faces.add(rows.list);
  }
}

} // namespace

void read_ply(Byte_source& file, const Input_settings& settings, Point_set& points, Input_notes& notes)
{
  Input_buffer in(file);
  Text_lines lines(in);
  const Header header = read_header(lines);
  const Element& element_of_points = points_of(header);
  std::uint64_t number_of_faces = 0;
  for(const Element& element : header.elements)
    number_of_faces += element.has_faces() ? element.count : 0;
  const Input_settings of_points = settings_of_corners(number_of_faces, settings);
  if(number_of_faces > 0 && settings.sample.value_or(0) > 0)
    notes.records.reset();           // the points of the output are others
  std::vector<std::uint64_t> places; // where the elements begin, and the end of the last one
  for(const Element& element : header.elements) {
    Rows rows(in, header.format, element);
    places.push_back(in.position());
    if(&element == &element_of_points)
      read_points(rows, element, of_points, points, notes);
    else
      rows.skip();
  }
  places.push_back(in.position());
  check_end(in, header.format == "ascii");
  if(notes.records)
    describe_records(file, header, places, notes);
  if(!samples_faces(number_of_faces, settings, notes))
    return;
  Mesh_faces mesh(points);
  for(std::size_t e = 0; e < header.elements.size(); ++e)
    if(const Element& element = header.elements[e]; element.has_faces()) {
      Input_buffer of_faces(file, places[e]);
      Rows rows(of_faces, header.format, element);
      add_faces(rows, element, mesh);
    }
  points = mesh.sample(settings, notes);
}

} // namespace program
