#include "legacy/result_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/csv.hpp"
#include "base/error.hpp"

namespace host {

namespace {

/// Columns on a terminal: bytes of UTF-8 that do not go on with a character.
std::size_t width(const std::string& text) {
  return std::size_t(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string padded(const std::string& text, std::size_t columns) {
  return text + std::string(columns - std::min(columns, width(text)), ' ');
}

std::string wrapped(const std::string& paragraph, std::size_t columns) {
  std::string text, line;
  std::size_t at = 0;
  while (at < paragraph.size()) {
    const std::size_t end = std::min(paragraph.find(' ', at), paragraph.size());
    const std::string word = paragraph.substr(at, end - at);
    if (!line.empty() && width(line) + 1 + width(word) > columns) text += line + "\n", line.clear();
    line += (line.empty() ? "" : " ") + word;
    at = end + 1;
  }
  return text + line + "\n";
}

}  // namespace

std::string to_text(const ResultTable& table) {
  std::vector<std::size_t> columns;
  for (std::size_t k = 0; k < table.header.size(); ++k) {
    columns.push_back(width(table.header[k]));
    for (const auto& row : table.rows) columns[k] = std::max(columns[k], width(row[k]));
  }
  const auto line = [&](const std::vector<std::string>& cells) {
    std::string text;
    for (std::size_t k = 0; k < cells.size(); ++k)
      text += padded(cells[k], columns[k]) + (k + 1 < cells.size() ? "  " : "");
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text + "\n";
  };
  std::string text = table.title + "\n\n" + line(table.header);
  for (const auto& row : table.rows) text += line(row);
  for (const std::string& note : table.notes) text += "\n" + wrapped(note, 110);
  return text;
}

std::string to_csv(const ResultTable& table) {
  std::string text = csv_line(table.header);
  for (const auto& row : table.rows) text += csv_line(row);
  return text;
}

std::string to_markdown(const ResultTable& table) {
  std::string text = table.title + "\n\n";
  text += fmt::format("| {} |\n|{}\n", fmt::join(table.header, " | "),
                      fmt::join(std::vector<std::string>(table.header.size(), " --- |"), ""));
  for (const auto& row : table.rows) text += fmt::format("| {} |\n", fmt::join(row, " | "));
  for (const std::string& note : table.notes) text += "\n" + note + "\n";
  return text;
}

std::string with_tables(const std::string& document, const std::vector<ResultTable>& tables,
                        const std::string& where) {
  constexpr std::string_view kEnd = "<!-- end -->";
  std::string text = document;
  for (const ResultTable& table : tables) {
    const std::string mark = fmt::format("<!-- {} -->\n", table.file);
    const std::size_t at = text.find(mark);
    if (at == std::string::npos) continue;
    const std::size_t from = at + mark.size(), to = text.find(kEnd, from);
    if (to == std::string::npos)
      throw Error(fmt::format("{}: \"{}\" has no \"{}\" after it", where,
                              mark.substr(0, mark.size() - 1), kEnd));
    text.replace(from, to - from, to_markdown(table));
  }
  return text;
}

std::string short_number(double value) { return fmt::format("{:.3g}", value); }

std::string beside(double ours, double theirs) {
  return fmt::format("{} ({})", short_number(ours), short_number(theirs));
}

}  // namespace host
