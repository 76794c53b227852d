#include "sensor/source_uri.h"

#include <algorithm>

#include "core/error.h"

namespace vfit {

namespace {

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

/// A % without two hexadecimal digits stays.
std::string decode(const std::string& encoded) {
    std::string out;
    for (size_t i = 0; i < encoded.size(); ++i) {
        const bool is_code = encoded[i] == '%' && i + 2 < encoded.size() && hex_digit(encoded[i + 1]) >= 0 &&
                             hex_digit(encoded[i + 2]) >= 0;
        if (is_code) {
            out += static_cast<char>(hex_digit(encoded[i + 1]) * 16 + hex_digit(encoded[i + 2]));
            i += 2;
        } else {
            out += encoded[i];
        }
    }
    return out;
}

/// A plug-in takes C strings, which end at a zero byte.
void refuse_zero_bytes(const std::string& decoded, const char* what, const std::string& encoded) {
    if (decoded.find('\0') != std::string::npos)
        fail(VFIT_ERROR_ARGUMENT, what, " '", encoded, "' of a source's URI: %00 is not allowed");
}

SourceOption parse_option(const std::string& part) {
    const size_t equals = part.find('=');
    if (equals == std::string::npos)
        fail(VFIT_ERROR_ARGUMENT, "option '", part,
             "' of a source's URI has no value; options are KEY=VALUE, separated by &, and a ? in a path is "
             "%3F");
    if (equals == 0)
        fail(VFIT_ERROR_ARGUMENT, "option '", part,
             "' of a source's URI has no key; options are KEY=VALUE, separated by &");
    SourceOption option{decode(part.substr(0, equals)), decode(part.substr(equals + 1))};
    refuse_zero_bytes(option.key + option.value, "option", part);
    return option;
}

}  // namespace

std::string scheme_of(const std::string& uri) {
    const size_t colon = uri.find(':');
    return colon == std::string::npos || colon < 2 ? std::string() : uri.substr(0, colon);
}

std::vector<SourceOption> parse_source_options(const std::string& query) {
    std::vector<SourceOption> options;
    for (size_t at = 0; at < query.size();) {
        const size_t end = std::min(query.find('&', at), query.size());
        const std::string part = query.substr(at, end - at);
        at = end + 1;
        if (part.empty()) continue;
        SourceOption option = parse_option(part);
        for (const SourceOption& earlier : options)
            if (earlier.key == option.key)
                fail(VFIT_ERROR_ARGUMENT, "option ", option.key, ": is given twice, as '", earlier.value,
                     "' and as '", option.value, "'; a source's URI gives each option once");
        options.push_back(std::move(option));
    }
    return options;
}

SourceUri parse_source_uri(const std::string& uri, bool has_address) {
    SourceUri out;
    out.scheme = scheme_of(uri);
    const std::string rest = uri.substr(out.scheme.size() + 1);
    if (!has_address) {
        out.options = parse_source_options(rest.substr(rest.rfind('?', 0) == 0 ? 1 : 0));
        return out;
    }
    const size_t query = std::min(rest.find('?'), rest.size());
    const std::string address = rest.substr(0, query);
    out.address = decode(address);
    refuse_zero_bytes(out.address, "the address", address);
    out.options = parse_source_options(rest.substr(std::min(query + 1, rest.size())));
    return out;
}

std::string encode_device(const std::string& device) {
    std::string out;
    for (const char c : device) {
        if (c == '%')
            out += "%25";
        else if (c == '?')
            out += "%3F";
        else
            out += c;
    }
    return out;
}

}  // namespace vfit
