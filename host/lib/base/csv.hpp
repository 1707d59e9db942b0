// Comma-separated tables [RFC 4180]: quoted fields, line numbers for messages, columns found by
// name.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace host {

struct CsvRow {
  std::size_t line = 0;  // 1-based line of the file on which the row starts
  std::vector<std::string> cells;
};

/// A table with a header. Every row has as many cells as the header.
struct CsvTable {
  std::string name;  // file name, for messages
  std::vector<std::string> header;
  std::vector<CsvRow> rows;

  /// Index of the column `title`, if there is one.
  std::optional<std::size_t> find(std::string_view title) const;
  /// Index of the column `title`; throws Error that names file, column and what is there.
  std::size_t column(std::string_view title) const;
};

/// Splits `text`: commas, double quotes ("" inside is one quote), LF or CRLF, an optional UTF-8
/// mark, blanks around the titles of columns. Blank lines are skipped. Throws Error for a missing
/// header, a title twice, a wrong cell count or an open quote. Ragged: rows of another cell count
/// are kept as they are, for tables of which a bad row must not stop the run.
enum class CsvRows { strict, ragged };
CsvTable parse_csv(std::string_view text, const std::string& name, CsvRows rows = CsvRows::strict);

/// parse_csv of a file; "-" is standard input.
CsvTable read_csv(const std::string& path, CsvRows rows = CsvRows::strict);

/// One cell, quoted only where commas, quotes, line ends or outer blanks ask for it.
std::string csv_cell(std::string_view text);

/// One line with its line end.
std::string csv_line(const std::vector<std::string>& cells);

/// 17 significant digits, so that reading gives the same double; "nan", "inf", "-inf" otherwise.
std::string csv_number(double value);

}  // namespace host
