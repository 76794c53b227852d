// JSON text to values and back: what may be read and how a fault is told. Here alone, so that the parser and
// the writer are compiled once.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

namespace vfit {

using Json = nlohmann::json;

/// Fails with VFIT_ERROR_DATA, beginning with `what`, where the text is not JSON, is cut, or nests deeper
/// than any file of ours: a file of brackets alone would cost gigabytes before anything looks at it.
Json parse_json(std::string_view text, const char* what);
Json parse_json(std::span<const std::byte> text, const char* what);

/// Brackets within brackets, not counting quoted ones. For readers that parse JSON of their own.
bool nests_deeper(std::string_view text, int levels);

/// Without a byte that is none of UTF-8.
bool is_utf8(const std::string& text);

/// On one line, or with that many blanks a level.
std::string json_text(const Json& value, int indent = -1);

}  // namespace vfit
