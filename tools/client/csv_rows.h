// Rows of a table with commas, one after the other, and their numbers; each fault names file, line and
// column.
#pragma once

#include <cstdint>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

namespace vfit::tools {

class CsvRows {
public:
    /// A row is read when it is asked for, so that a stream may still be written. file is its name in
    /// messages.
    CsvRows(std::istream& in, std::string file);

    /// The next row that is not empty; false at the end.
    bool next();
    size_t size() const { return cells_.size(); }
    /// Until the next row.
    std::string_view cell(size_t column) const { return cells_[column]; }
    /// Cells of a row that must have `wanted` of them.
    void check_size(size_t wanted) const;

    double number(size_t column) const;
    float coordinate(size_t column) const;  // may be NaN, never infinite
    int64_t whole_number(size_t column) const;

    [[noreturn]] void fail(const std::string& fault) const;
    [[noreturn]] void fail(size_t column, const std::string& fault) const;

private:
    std::istream& in_;
    std::string file_, text_;  // text_: the row
    size_t line_ = 0;
    std::vector<std::string_view> cells_;
};

}  // namespace vfit::tools
