// Copyright (c) 2026 The Tandem authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Text tables: what stands before the points, what the columns are, and the points.

#include "../cloud_warnings.h"
#include "input/readers.h"
#include "input/recognize_columns.h"

namespace program {

namespace {

bool is_integer(std::string_view value)
{
  if(!value.empty() && (value.front() == '-' || value.front() == '+'))
    value.remove_prefix(1);
  return !value.empty() && std::all_of(value.begin(), value.end(), is_digit);
}

// As in 1,5,2,5,3,5, or 1,5, 2,5, 3,5 if there are blanks behind every second comma only. No part behind a decimal
// comma has a sign.
bool has_pairs_of_integers(std::string_view row, bool has_blanks)
{
  const Cells cells = values_of(row);
  const char* end = nullptr; // of the cell before
  for(std::size_t c = 0; c < cells.size(); ++c) {
    const bool is_second = c % 2 == 1, has_blank = c > 0 && cells[c].data() != end + 1;
    if(!is_integer(cells[c]) || (is_second && !is_digit(cells[c][0])) ||
       (c > 0 && has_blank != (has_blanks && !is_second)))
      return false;
    end = cells[c].data() + cells[c].size();
  }
  return separator_of(row) == ',' && cells.size() >= 6 && cells.size() % 2 == 0;
}

// What tells the columns: --columns, a line of names, or the values.
enum class Source { option, header, sample };

// What stands before the points, and the first of them.
struct Table_head {
  Source source = Source::sample;
  std::vector<Column> columns;
  std::vector<std::string> names; // of the columns, where a line has them
  bool has_skipped_names = false; // which --columns replaces
  std::vector<std::string> notes; // on the columns that are passed over
  double step = 0;                // by which the first column rises from row to row, which is why it is passed over
  double channel_unit = 1;        // of colors: channels from 0 to 1 become 16 bits
  bool is_geographic = false;
  std::optional<std::size_t> count;
  std::vector<Text_row> rows;
};

// Says what is wrong with a row, and what may be wrong with its commas.
template <class... Words>
[[noreturn]] void fail_at(const Text_row& row, const Words&... words)
{
  fail_at_row(row.number, words..., advice_on_commas(row.text),
              row.text.find(',') == row.text.npos ? "" : " (or give --decimal-comma)");
}

// The first rows of a table, all with as many values; NaN for what is no number.
using Sample = std::vector<std::vector<double>>;

// Of the rows that have values there: some scanners write NaN where nothing came back.
template <class Is_right>
bool all_values(const Sample& rows, std::size_t first, Is_right is_right)
{
  std::size_t count = 0;
  for(const std::vector<double>& row : rows) {
    const double values[3] = {row[first], row[first + 1], row[first + 2]};
    if(std::any_of(values, values + 3, [](double x) { return std::isnan(x); }))
      continue;
    if(!std::all_of(values, values + 3, is_right))
      return false;
    ++count;
  }
  return count > 0;
}

bool are_integer_colors(const Sample& rows, std::size_t first)
{
  return all_values(rows, first, [](double x) { return x >= 0 && x <= 65535 && x == std::floor(x); });
}

// Channels from 0 to 1, at least one of which is between.
bool are_real_colors(const Sample& rows, std::size_t first)
{
  return all_values(rows, first, [](double x) { return x >= 0 && x <= 1; }) && !are_integer_colors(rows, first);
}

bool is_number(const Sample& rows, std::size_t column)
{
  return std::none_of(rows.begin(), rows.end(), [=](const auto& row) { return std::isnan(row[column]); });
}

using Names = std::initializer_list<const char*>;

// Names of the coordinates beside x, y and z: none, those of maps, such as Easting and Northing, and those of the globe.
const Names coordinate_names[3][3] = {
  {},
  {{"easting", "east", "e", "x"},
   {"northing", "north", "n", "y"},
   {"elevation", "elev", "height", "h", "altitude", "alt", "z"}},
  {{"lon", "long", "longitude"}, {"lat", "latitude"}, {"height", "h", "altitude", "alt", "elevation"}}};

// Of a name without a unit in parentheses.
Column column_of(const std::string& text, const Names (&coordinates)[3])
{
  const std::string plain = plain_name(text), name = plain.substr(0, plain.find_first_of("(["));
  for(int c = 0; c < 3; ++c)
    if(is_in(name, coordinates[c]))
      return Column(c);
  return column_of_name(text);
}

// The columns of these names, or none if they do not name x, y and z. Each but for the first of a kind is passed over.
std::vector<Column> columns_of(const std::vector<std::string>& names, bool& is_geographic)
{
  for(const auto& coordinates : coordinate_names) {
    std::vector<Column> columns;
    for(const std::string& name : names) {
      const Column c = column_of(name, coordinates);
      columns.push_back(has_column(columns, c) ? Column::none : c);
    }
    remove_incomplete(columns);
    if(!has_coordinates(columns))
      continue;
    is_geographic = &coordinates == &coordinate_names[2];
    return columns;
  }
  return {};
}

void place(std::vector<Column>& columns, std::size_t first, Column name)
{
  for(int i = 0; i < 3; ++i)
    columns[first + std::size_t(i)] = Column(int(name) + i);
}

// Most of the normals in the columns from `first` on have length 1.
bool are_normals(const Sample& rows, std::size_t first)
{
  std::size_t unit = 0, other = 0;
  for(const std::vector<double>& row : rows) {
    const double length =
      std::sqrt(row[first] * row[first] + row[first + 1] * row[first + 1] + row[first + 2] * row[first + 2]);
    const bool is_unit = std::fabs(length - 1) <= largest_error_of_length;
    unit += is_unit ? 1 : 0;
    other += !is_unit && length > 0 ? 1 : 0;
  }
  return unit > 9 * other;
}

// The columns of a table without a line of names, of which x is the column `first`. In a .pts file the intensity comes
// before the colors; files .pwn and .xyzn have normals, those of .xyzrgb colors.
std::vector<Column> recognize_columns(const Sample& rows, std::size_t first, const std::string& extension)
{
  const std::size_t all = rows.empty() ? 0 : rows.front().size(), count = all - first;
  if(all < first + 3)
    return {};
  std::vector<Column> columns(all, Column::none);
  place(columns, first, Column::x);
  std::size_t c = first + 3;
  if(extension == ".pts" && (count == 4 || count == 7))
    columns[c++] = Column::intensity;
  const bool has_normals = extension == ".pwn" || extension == ".xyzn";
  if((has_normals || extension == ".xyzrgb") && count >= 6) {
    place(columns, c, has_normals ? Column::nx : Column::red);
    c += 3;
  }
  while(c + 3 <= all) {
    const bool is_normal = !has_column(columns, Column::nx) && are_normals(rows, c);
    const bool is_color =
      !is_normal && !has_column(columns, Column::red) && (are_integer_colors(rows, c) || are_real_colors(rows, c));
    if(is_normal || is_color)
      place(columns, c, is_normal ? Column::nx : Column::red);
    c += is_normal || is_color ? 3 : 1;
  }
  // A single number that is left is the intensity.
  const auto begin = columns.begin() + std::ptrdiff_t(first), left = std::find(begin, columns.end(), Column::none);
  if(std::count(begin, columns.end(), Column::none) == 1 && !has_column(columns, Column::intensity) &&
     is_number(rows, std::size_t(left - columns.begin())))
    *left = Column::intensity;
  return columns;
}

// --- Where the coordinates begin.

std::vector<Column_look> looks_of(const std::vector<Text_row>& rows)
{
  std::vector<Cells> columns;
  for(const Text_row& row : rows) {
    const Cells cells = values_of(row.text);
    if(columns.empty())
      columns.resize(cells.size());
    for(std::size_t c = 0; c < cells.size() && cells.size() == columns.size(); ++c)
      columns[c].push_back(cells[c]);
  }
  std::vector<Column_look> looks;
  for(const Cells& values : columns)
    looks.push_back(look_at(values));
  return looks;
}

bool has_numbers(const std::vector<Column_look>& looks, std::size_t first, std::size_t count)
{
  const auto begin = looks.begin() + std::ptrdiff_t(first);
  return first + count <= looks.size() &&
         std::none_of(begin, begin + std::ptrdiff_t(count), [](const Column_look& look) { return look.has_words; });
}

std::string name_of_place(std::size_t column, const std::string& what)
{
  return "column " + std::to_string(column + 1) + ": " + what;
}

// The first of the three coordinates. Notes why columns before it are passed over. An exception where it is not known.
std::size_t find_x(const Sample& rows, const std::vector<Column_look>& looks, const std::string& extension,
                   Table_head& head)
{
  std::size_t first = 0;
  for(; first + 3 < looks.size() && !has_numbers(looks, first, 3); ++first)
    head.notes.push_back(name_of_place(first, looks[first].has_words ? "words" : "numbers"));
  for(; has_numbers(looks, first, 4); ++first) {
    if(first + 6 <= looks.size() && are_normals(rows, first + 3))
      break;
    const Column_verdict verdict = judge_x(looks, first);
    const std::string what = name_of_place(first, verdict.reason);
    if(verdict.reason.empty())
      break;
    if(!verdict.is_certain)
      throw_error("x may be column ", first + 1, " or ", first + 2, " (", what, "): pass --columns '",
                  names_of(recognize_columns(rows, first, extension)), "' or --columns '",
                  names_of(recognize_columns(rows, first + 1, extension)), "'");
    head.notes.push_back(what);
    head.step = verdict.is_by_step && first == 0 ? looks[0].step : 0;
  }
  return first;
}

// The rows that have as many values as the first one; the others are reported when they are read.
Sample sample_of(const std::vector<Text_row>& rows)
{
  Sample sample;
  for(const Text_row& row : rows) {
    std::vector<double> numbers;
    for(std::string_view value : values_of(row.text))
      numbers.push_back(parse_number(value).value_or(std::numeric_limits<double>::quiet_NaN()));
    if(sample.empty() || numbers.size() == sample.front().size())
      sample.push_back(numbers);
  }
  return sample;
}

std::size_t parse_count(const Text_row& row, std::string_view text)
{
  long long count = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), count);
  if(end.ec != std::errc() || end.ptr != text.data() + text.size())
    fail_at(row, "is neither a point, the number of points nor a line of names (comments begin with # or //)");
  if(count < 0)
    throw_error("announces ", count, " points");
  return std::size_t(count);
}

// Its coordinates are numbers, or empty; three values next to each other may be some where no columns are known.
bool is_point(const Cells& values, const std::vector<Column>& columns)
{
  std::size_t numbers = 0; // next to each other
  for(auto value = values.begin(); value != values.end() && columns.empty() && numbers < 3; ++value)
    numbers = parse_number(*value) ? numbers + 1 : 0;
  if(columns.empty())
    return numbers == 3;
  for(Column c : {Column::x, Column::y, Column::z}) {
    const std::size_t place = std::size_t(std::find(columns.begin(), columns.end(), c) - columns.begin());
    if(place >= values.size() || !parse_number(values[place]))
      return false;
  }
  return true;
}

// Words, none of which is a number.
bool are_names(const Cells& values)
{
  const auto is_word = [](std::string_view value) {
    const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
    return std::any_of(value.begin(), value.end(), is_letter) && !parse_number(value);
  };
  return values.size() >= 3 && std::all_of(values.begin(), values.end(), is_word);
}

// A line before the first point.
void read_head_line(const Text_row& row, Table_head& head)
{
  const Cells cells = values_of(row.text);
  if(!cells.empty() && plain_name(cells[0]) == "ncols")
    throw std::runtime_error("is a raster of ESRI (its first word is ncols), not a table of points; convert it, for "
                             "example with gdal_translate -of XYZ");
  const bool has_note = is_comment(row.text);
  if(!has_note && is_point(cells, head.columns)) {
    head.rows.push_back(row);
    return;
  }
  std::string_view line = row.text;
  line.remove_prefix((std::min)(line.find_first_not_of(" \t#/"), line.size()));
  const Cells words = values_of(line);
  const std::vector<std::string> names(words.begin(), words.end());
  const std::vector<Column> columns = columns_of(names, head.is_geographic);
  const bool has_option = head.source == Source::option;
  if(!columns.empty() && !has_option) {
    head.source = Source::header;
    head.columns = columns;
    head.names = names;
  } else if(has_note || !columns.empty()) {
    if(!has_note)
      head.names = names;
  } else if(!are_names(cells)) {
    head.count = parse_count(row, cells.size() == 1 ? cells[0] : "");
  } else if(std::exchange(head.has_skipped_names, true) || !has_option) {
    fail_at_row(row.number, "is a line of names without x, y and z (name the columns by --columns)");
  } else {
    head.names = names;
  }
}

void find_columns(const Sample& sample, const std::string& extension, const std::string& tolerance, Table_head& head)
{
  std::vector<Column>& columns = head.columns;
  if(head.source == Source::option)
    return;
  const std::vector<Column_look> looks = looks_of(head.rows);
  if(head.source == Source::sample) {
    if(!tolerance.empty())
      throw_error("has no line of names with '", tolerance, "' for --tolerance-column (name the columns by --columns)");
    columns = recognize_columns(sample, find_x(sample, looks, extension, head), extension);
    for(std::size_t c = head.notes.size(); c < columns.size(); ++c)
      if(columns[c] == Column::none)
        head.notes.push_back(name_of_place(c, looks[c].has_words    ? "words"
                                              : looks[c].is_integer ? "integers"
                                                                    : "numbers"));
    return;
  }
  if(!tolerance.empty())
    columns[find_name(head.names, tolerance, "column")] = Column::tolerance;
  remove_incomplete(columns);
  if(!has_coordinates(columns))
    throw_error("the column '", tolerance, "' of --tolerance-column is a coordinate");
  const bool has_more = looks.size() == head.names.size() + 1; // a column that pandas writes
  if(const Column_verdict verdict = has_more ? judge_x(looks, 0) : Column_verdict();
     verdict.is_certain && !verdict.reason.empty()) {
    head.notes.push_back(name_of_place(0, verdict.reason));
    head.step = verdict.is_by_step ? looks[0].step : 0;
    columns.insert(columns.begin(), Column::none);
    head.names.insert(head.names.begin(), "");
  }
  for(std::size_t c = 0; c < columns.size(); ++c)
    if(columns[c] == Column::none && !is_no_name(head.names[c]))
      head.notes.push_back(name_of_place(c, head.names[c]));
}

double channel_unit_of(const std::vector<Column>& columns, const Sample& sample)
{
  const std::size_t first = std::size_t(std::find(columns.begin(), columns.end(), Column::red) - columns.begin());
  const bool is_triple = first + 2 < columns.size() && columns[first + 1] == Column::green;
  return is_triple && !sample.empty() && first + 2 < sample.front().size() && are_real_colors(sample, first) ? 65535
                                                                                                             : 1;
}

Table_head read_head(Text_lines& lines, const std::string& extension, const Input_settings& settings)
{
  constexpr std::size_t most_rows = 1000, most_bytes = 1 << 20;
  Table_head head;
  head.columns = settings.columns;
  head.source = settings.columns.empty() ? Source::sample : Source::option;
  for(std::size_t bytes = 0; head.rows.size() < most_rows && bytes < most_bytes && lines.next_filled();)
    if(head.rows.empty()) {
      read_head_line(lines.row(), head);
    } else if(!is_comment(lines.row().text)) {
      head.rows.push_back(lines.row());
      bytes += lines.row().text.size();
    }
  // As many values as names are told what they are.
  const auto has_pairs = [](const Text_row& row) { return has_pairs_of_integers(row.text, true); };
  if(!head.rows.empty() && values_of(head.rows[0].text).size() != head.columns.size() &&
     std::all_of(head.rows.begin(), head.rows.end(), has_pairs))
    fail_at(head.rows[0], "has pairs of integers, such as 1,5, 2,5");
  const Sample sample = sample_of(head.rows);
  find_columns(sample, extension, settings.tolerance, head);
  head.channel_unit = channel_unit_of(head.columns, sample);
  return head;
}

// --- Commas separate values. Where they are parts of numbers instead, the values are others than those of the file.

// 05 after 1, of 1,05; and 034.5 after 1, of 1,034.5. No number is written so.
bool is_rest_of_number(std::string_view before, std::string_view value)
{
  return value.size() > 1 && value[0] == '0' && is_digit(value[1]) && is_integer(before);
}

// Finds the columns that records keep, and describes the records.
std::vector<std::size_t> kept_columns(const Table_head& head, const Input_settings& settings, Input_notes& notes)
{
  Input_records& records = *notes.records;
  const std::size_t values = head.rows.empty() ? 0 : values_of(head.rows[0].text).size();
  std::vector<std::size_t> kept;
  records.head = {""};
  for(std::size_t c = 0; c < (std::max)(values, head.columns.size()); ++c) {
    const Column column = c < head.columns.size() ? head.columns[c] : Column::none;
    const bool has_name = c < head.names.size();
    const std::string name = !has_name ? name_of(column) : head.names[c].empty() ? "_" : head.names[c];
    if(!keeps_field(name, column, settings, notes))
      continue;
    kept.push_back(c);
    records.head[0] += name + end_of_value;
  }
  records.encoding = Encoding::text;
  records.layout = text_of(records.head[0], head.channel_unit);
  return kept;
}

// Makes points of the rows of a table, and looks at what may be wrong with them.
class Table_reader {
public:
  Table_reader(const Table_head& head, const Input_settings& settings, Point_set& points, Input_notes& notes)
    : head(head), columns(head.columns), notes(notes),
      fields(fields_of([this](Column c) { return has_column(columns, c); })), builder(points, fields, settings, notes),
      may_be_decimal(head.source == Source::sample && !head.rows.empty())
  {
    if(notes.records)
      kept = kept_columns(head, settings, notes);
  }

  void add(const Text_row& row)
  {
    Cells cells = values_of(row.text);
    if(cells.size() + 1 == columns.size() && (row.text.back() == ',' || row.text.back() == ';'))
      cells.emplace_back(); // the last value is empty
    parse(row, cells);
    Point_row point = row_of(values);
    for(std::size_t i = 0; i < 3; ++i)
      point.color[i] = clamped<std::uint16_t>(head.channel_unit * values[std::size_t(Column::red) + i]);
    point.classification = clamped<std::uint8_t>(values[std::size_t(Column::classification)]);
    if(builder.add(point) && notes.records) {
      for(std::size_t c : kept)
        (notes.records->bytes += c < cells.size() ? cells[c] : "") += end_of_value;
      notes.records->add("");
    }
    if(fields.normal)
      look_at_normal(point.normal);
    look_at_commas(row);
    if(head.step != 0 && break_at == 0) { // it may not go on like that
      const double number = parse_number(cells[0]).value_or(0);
      break_at =
        count > 0 && !(std::fabs(number - last_number - head.step) < std::fabs(head.step) / 2) ? row.number : 0;
      last_number = number;
    }
    ++count;
  }

  void finish()
  {
    if(head.channel_unit == 1)
      builder.widen_colors();
    if(2 * strange > count)
      notes.warnings.push_back(text_of("the normals (nx ny nz, columns ", places(),
                                       ") have lengths far from 1, such as ", std::to_string(example),
                                       "; name the columns by --columns if these are no normals"));
    if(may_be_decimal)
      report_commas();
    if(break_at > 0)
      notes.warnings.push_back(text_of("column 1 has equal steps until row ", break_at,
                                       ", so the program skips it; name the columns by --columns if it is a "
                                       "coordinate"));
    if(head.count && *head.count != count)
      throw_error("has ", count, " rows of points, but announces ", *head.count);
  }

private:
  void parse(const Text_row& row, const Cells& cells)
  {
    const bool has_commas = separator_of(row.text) == ',';
    bool is_split = false; // a number, by a comma
    for(std::size_t c = 0; c < columns.size(); ++c) {
      if(c >= cells.size())
        fail_at_row(row.number, "has ", c, " values instead of ", columns.size());
      is_split = is_split || (c > 0 && has_commas && is_rest_of_number(cells[c - 1], cells[c]));
      if(columns[c] == Column::none)
        continue;
      const std::optional<double> number = parse_number(cells[c]);
      if(!number)
        fail_at(row, "has '", cells[c].substr(0, 40), "' where the number ", name_of(columns[c]), " is expected");
      values[std::size_t(columns[c])] = *number;
    }
    if(cells.size() > columns.size() && (head.source != Source::option || has_commas))
      fail_at(row, "has more than ", columns.size(), " values (name all its columns by --columns, those to skip by _)");
    if(is_split && head.source == Source::sample)
      fail_at(row, "has a number with a leading 0 after a comma, as in 1,05: the comma may be a decimal comma (if it "
                   "separates two values, name all columns by --columns)");
  }

  void look_at_normal(const double (&n)[3])
  {
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if(!(length > 0) || std::fabs(length - 1) <= largest_error_of_length)
      return;
    example = strange++ == 0 ? length : example;
  }

  std::string places() const
  {
    std::string text;
    for(std::size_t c = 0; c < columns.size(); ++c)
      if(columns[c] == Column::nx || columns[c] == Column::ny || columns[c] == Column::nz)
        text += (text.empty() ? "" : " ") + std::to_string(c + 1);
    return text;
  }

  // Commas may be decimal ones, as in 4,4,17,4,1,1, though they are read as others.
  void look_at_commas(const Text_row& row)
  {
    may_be_decimal = may_be_decimal && has_pairs_of_integers(row.text, false);
    for(Column c : {Column::red, Column::green, Column::blue})
      has_wide_colors = has_wide_colors || values[std::size_t(c)] > 255;
  }

  // Colors of 16 bits are too rare in such a table.
  void report_commas()
  {
    const std::string text = "each row has integers with commas between them, read as " + names_of(columns) +
                             (has_wide_colors ? " with values above 255 for r g b" : "") +
                             ": if the commas are decimal commas, write decimal points; otherwise name the columns by "
                             "--columns";
    if(has_wide_colors)
      throw std::runtime_error(text);
    notes.warnings.push_back(text);
  }

  const Table_head& head;
  const std::vector<Column>& columns;
  Input_notes& notes;
  Fields fields;
  Cloud_builder builder;
  Row_values values = {};
  std::vector<std::size_t> kept; // columns, in the records of points
  bool may_be_decimal, has_wide_colors = false;
  std::size_t count = 0, strange = 0; // rows, normals
  double example = 0, last_number = 0;
  std::size_t break_at = 0; // the row
};

} // namespace

void read_table(Byte_source& file, const std::string& extension, const Input_settings& settings, Point_set& points,
                Input_notes& notes)
{
  Input_buffer in(file);
  Text_lines lines(in, settings.has_decimal_commas);
  const Table_head head = read_head(lines, extension, settings);
  if(!settings.classes.empty() && !has_column(head.columns, Column::classification))
    throw_error("has no classification, which --classes needs (its columns: ", names_of(head.columns), ")");
  Table_reader reader(head, settings, points, notes);
  for(const Text_row& row : head.rows)
    reader.add(row);
  while(lines.next_filled())
    if(!is_comment(lines.row().text))
      reader.add(lines.row());
  reader.finish();
  notes.lines.emplace_back("columns", names_of(head.columns) +
                                        (head.notes.empty() ? "" : " (" + boost::join(head.notes, "; ") + ")"));
  if(head.is_geographic)
    notes.warnings.push_back("x and y are columns of longitude and latitude: planes need lengths, so " +
                             std::string(tandem_examples::advice_on_degrees));
}

} // namespace program
