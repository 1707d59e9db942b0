// A table of results: aligned text for a terminal, CSV for tools, Markdown for documents.
#pragma once
#include <string>
#include <vector>

namespace host {

struct ResultTable {
  std::string file;   ///< name without ending, "table4.1"
  std::string title;  ///< one sentence
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;  ///< cells as they are shown
  std::vector<std::string> notes;              ///< paragraphs below the table
};

std::string to_text(const ResultTable& table);
std::string to_csv(const ResultTable& table);
std::string to_markdown(const ResultTable& table);

/// The document with what stands between "<!-- FILE -->" and "<!-- end -->" replaced by the table
/// of that name. `where` names the document in messages. Error for a mark without an end.
std::string with_tables(const std::string& document, const std::vector<ResultTable>& tables,
                        const std::string& where);

/// Three significant digits: "0.0123", "4.1e-05".
std::string short_number(double value);
/// "ours (theirs)".
std::string beside(double ours, double theirs);

}  // namespace host
