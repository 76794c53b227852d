// The URI of a source: its scheme, its address and its options.
//
//   SCHEME:ADDRESS?KEY=VALUE&KEY=VALUE
//
// The first ? ends the address, & separates options. %XX stands for one byte in addresses, keys and values,
// so that %3F is a ? of a path.
#pragma once

#include <string>
#include <vector>

namespace vfit {

struct SourceOption {
    std::string key, value;
};

struct SourceUri {
    std::string scheme, address;
    std::vector<SourceOption> options;  // in the order of the URI, each key once

    /// What a plug-in opens: the URI without its options, decoded.
    std::string device() const { return scheme + ":" + address; }
};

/// What precedes the first colon; empty without one, or where a single letter names a drive of Windows.
std::string scheme_of(const std::string& uri);

/// Splits a URI that has a scheme. Without an address, options follow the colon; a ? before them may be
/// missing. Fails with VFIT_ERROR_ARGUMENT, naming the option that is not KEY=VALUE or that is given twice.
SourceUri parse_source_uri(const std::string& uri, bool has_address);

/// The options of "KEY=VALUE&KEY=VALUE", decoded; empty parts are skipped. Fails as parse_source_uri does.
std::vector<SourceOption> parse_source_options(const std::string& query);

/// A URI that parse_source_uri takes for `device` with no options: % and ? are encoded.
std::string encode_device(const std::string& device);

}  // namespace vfit
