// Bytes that were a good file once.
#pragma once
#include <string>
#include <vector>

#include "network/random.hpp"

namespace host {

/// One to eight changes: bits turned, bytes and lines cut, doubled, moved or put in, numbers
/// replaced by hostile ones, words of `words` put in, the end cut off, another text's lines mixed
/// in.
std::string mutated(const std::string& text, const std::string& other,
                    const std::vector<std::string>& words, Random& random);

}  // namespace host
