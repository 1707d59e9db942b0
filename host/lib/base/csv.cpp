#include "base/csv.hpp"

#include <algorithm>
#include <charconv>
#include <system_error>

#include "base/error.hpp"
#include "base/file.hpp"

namespace host {
namespace {

std::string trimmed(const std::string& text) {
  constexpr const char* kBlanks = " \t";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string place(const std::string& name, std::size_t line) {
  return name + ":" + std::to_string(line) + ": ";
}

/// Reads one row after another; a quoted cell may hold commas, doubled quotes and line ends.
class Reader {
 public:
  Reader(std::string_view text, const std::string& name) : text_(text), name_(name) {
    constexpr std::string_view kMark = "\xEF\xBB\xBF";
    if (text_.substr(0, kMark.size()) == kMark) at_ = kMark.size();
  }

  /// False at the end of the text. Blank lines are passed over.
  bool next(CsvRow* row) {
    while (at_ < text_.size() && end_of_line()) skip_line_end();
    if (at_ >= text_.size()) return false;
    row->line = line_;
    row->cells.clear();
    do {
      row->cells.push_back(cell());
    } while (take_comma());
    if (at_ < text_.size()) {
      if (!end_of_line())
        throw Error(place(name_, line_) +
                    "text after a closing quote; double the quote or drop it");
      skip_line_end();
    }
    return true;
  }

 private:
  bool end_of_line() const {
    return text_[at_] == '\n' ||
           (text_[at_] == '\r' && (at_ + 1 == text_.size() || text_[at_ + 1] == '\n'));
  }
  void skip_line_end() {
    if (text_[at_] == '\r') ++at_;
    if (at_ < text_.size() && text_[at_] == '\n') ++at_;
    ++line_;
  }
  bool take_comma() {
    if (at_ >= text_.size() || text_[at_] != ',') return false;
    ++at_;
    return true;
  }
  std::string cell() {
    if (at_ < text_.size() && text_[at_] == '"') return quoted_cell();
    const std::size_t first = at_;
    while (at_ < text_.size() && text_[at_] != ',' && !end_of_line()) ++at_;
    return std::string(text_.substr(first, at_ - first));
  }
  std::string quoted_cell() {
    const std::size_t open_line = line_;
    std::string cell;
    for (++at_; at_ < text_.size(); ++at_) {
      if (text_[at_] == '"') {
        if (at_ + 1 >= text_.size() || text_[at_ + 1] != '"') {
          ++at_;
          return cell;
        }
        ++at_;
      }
      if (text_[at_] == '\n') ++line_;
      cell += text_[at_];
    }
    throw Error(place(name_, open_line) + "a quote is opened and never closed");
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
};

}  // namespace

std::optional<std::size_t> CsvTable::find(std::string_view title) const {
  const auto found = std::find(header.begin(), header.end(), title);
  if (found == header.end()) return std::nullopt;
  return static_cast<std::size_t>(found - header.begin());
}

std::size_t CsvTable::column(std::string_view title) const {
  if (const auto found = find(title)) return *found;
  std::string titles;
  for (const std::string& other : header) titles += (titles.empty() ? "" : ",") + other;
  throw Error(name + ":1: no column '" + std::string(title) + "'; the header is '" + titles + "'");
}

CsvTable parse_csv(std::string_view text, const std::string& name, CsvRows rows) {
  CsvTable table;
  table.name = name;
  Reader reader(text, name);
  CsvRow row;
  if (!reader.next(&row)) throw Error(name + ":1: empty; the first line must name the columns");
  for (const std::string& title : row.cells) table.header.push_back(trimmed(title));
  for (auto title = table.header.begin(); title != table.header.end(); ++title)
    if (std::find(table.header.begin(), title, *title) != title)
      throw Error(place(name, row.line) + "the column '" + *title + "' is there twice");
  while (reader.next(&row)) {
    if (rows == CsvRows::strict && row.cells.size() != table.header.size())
      throw Error(place(name, row.line) + std::to_string(row.cells.size()) +
                  " cells; the header has " + std::to_string(table.header.size()));
    table.rows.push_back(row);
  }
  return table;
}

CsvTable read_csv(const std::string& path, CsvRows rows) {
  return parse_csv(read_file(path), path, rows);
}

std::string csv_cell(std::string_view text) {
  const bool plain = text.find_first_of(",\"\r\n") == std::string_view::npos &&
                     (text.empty() || (text.front() != ' ' && text.back() != ' '));
  if (plain) return std::string(text);
  std::string cell = "\"";
  for (const char c : text) cell += c == '"' ? std::string("\"\"") : std::string(1, c);
  return cell + '"';
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) line += (&cell == cells.data() ? "" : ",") + csv_cell(cell);
  return line + '\n';
}

std::string csv_number(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 17);
  return {text, end.ptr};
}

}  // namespace host
