// Whole files at once.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace vfit {

/// The bytes of a file; VFIT_ERROR_IO naming it where it cannot be read or is larger than max_bytes.
std::vector<std::byte> read_file(const std::string& path, size_t max_bytes = size_t(1) << 30);

/// Names of the files data_dir/kind/*.json, in alphabetical order.
std::vector<std::string> data_names(const std::string& data_dir, const std::string& kind);

/// data_dir/kind/name.json for a name that stays inside that folder; VFIT_ERROR_ARGUMENT otherwise.
std::string data_file(const std::string& data_dir, const std::string& kind, const std::string& name);

}  // namespace vfit
