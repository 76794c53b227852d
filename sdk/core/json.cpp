#include "core/json.h"

#include "core/error.h"

namespace vfit {

namespace {

constexpr int kDeepest = 32;  // levels; the deepest file, a size chart, has 7

}  // namespace

bool nests_deeper(std::string_view text, int levels) {
    int depth = 0;
    bool quoted = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quoted) {
            if (c == '\\') ++i;
            quoted = c != '"';
        } else if (c == '"') {
            quoted = true;
        } else if (c == '{' || c == '[') {
            if (++depth > levels) return true;
        } else if (c == '}' || c == ']') {
            --depth;
        }
    }
    return false;
}

Json parse_json(std::string_view text, const char* what) {
    if (nests_deeper(text, kDeepest))
        fail(VFIT_ERROR_DATA, what, ": nested deeper than ", kDeepest, " levels");
    try {
        return Json::parse(text);
    } catch (const Json::exception& e) {
        // Without the library's own "[json.exception...]", and of a long token its beginning.
        constexpr size_t kMaxText = 200;
        std::string reason = e.what();
        if (const size_t end = reason.find("] "); end != std::string::npos) reason.erase(0, end + 2);
        if (reason.size() > kMaxText) reason = reason.substr(0, kMaxText) + " ...";
        fail(VFIT_ERROR_DATA, what, ": not JSON: ", reason);
    }
}

Json parse_json(std::span<const std::byte> text, const char* what) {
    return parse_json(std::string_view(reinterpret_cast<const char*>(text.data()), text.size()), what);
}

bool is_utf8(const std::string& text) {
    try {
        Json(text).dump();
        return true;
    } catch (const Json::type_error&) {
        return false;
    }
}

std::string json_text(const Json& value, int indent) { return value.dump(indent); }

}  // namespace vfit
