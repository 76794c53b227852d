// Rows of numbers from a CSV file, one after the other, in bounded memory. A last row without its line end
// is what a killed writer leaves; it counts only if it can be seen to be whole.
#pragma once

#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "support/failure.h"

namespace recording {

using plugin::fail;

class CsvFile {
public:
    /// Reads the header. Fails with VFIT_ERROR_IO or VFIT_ERROR_DATA, naming the file.
    explicit CsvFile(const std::filesystem::path& path);

    const std::vector<std::string>& columns() const { return columns_; }
    /// The next row; false at the end. Fails with VFIT_ERROR_DATA, naming file and line.
    bool next();
    /// Back to the first row.
    void rewind();

    bool empty(size_t column) const { return fields_[column].empty(); }
    /// A finite number.
    double number(size_t column) const;
    /// A whole number of at least `low`.
    int64_t integer(size_t column, int64_t low) const;

    template <typename... Parts>
    [[noreturn]] void refuse(const Parts&... why) const {
        fail(VFIT_ERROR_DATA, name_, ", line ", line_number_, ": ", why...);
    }

private:
    bool read_line();
    void split();
    bool is_whole() const;

    static constexpr size_t kMaxLine = 1 << 15;  // bytes; 23 joints take less than 2 kB
    const std::string name_;
    std::ifstream file_;
    std::vector<std::string> columns_;
    std::array<char, kMaxLine> line_{};
    std::string_view text_;  // of the line, without its end
    bool ended_ = false;     // it had one
    size_t line_number_ = 0;
    std::streampos first_row_;
    std::vector<std::string_view> fields_;
    size_t last_field_tail_ = 0;  // characters after the point of the last field, in the row before
};

}  // namespace recording
