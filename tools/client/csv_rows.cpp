#include "client/csv_rows.h"

#include <charconv>
#include <cmath>

#include "client/client.h"

namespace vfit::tools {

namespace {

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlanks = " \t\r";
    const size_t first = text.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlanks) + 1 - first);
}

template <typename T>
bool parse(std::string_view text, T& value) {
    const auto end = std::from_chars(text.data(), text.data() + text.size(), value);
    return end.ec == std::errc() && end.ptr == text.data() + text.size();
}

}  // namespace

CsvRows::CsvRows(std::istream& in, std::string file) : in_(in), file_(std::move(file)) {}

bool CsvRows::next() {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    while (std::getline(in_, text_)) {
        std::string_view line = text_;
        if (++line_ == 1 && line.starts_with(kByteOrderMark)) line.remove_prefix(kByteOrderMark.size());
        line = trimmed(line);
        if (line.empty()) continue;
        cells_.clear();
        for (size_t comma = 0; comma != std::string_view::npos;) {
            comma = line.find(',');
            cells_.push_back(trimmed(line.substr(0, comma)));
            if (comma != std::string_view::npos) line.remove_prefix(comma + 1);
        }
        return true;
    }
    if (in_.bad()) throw Failure(file_ + ": cannot be read");
    return false;
}

void CsvRows::check_size(size_t wanted) const {
    if (size() != wanted)
        fail(std::to_string(size()) + " columns, and the first line has " + std::to_string(wanted));
}

double CsvRows::number(size_t column) const {
    double value = 0;
    if (!parse(cell(column), value) || !std::isfinite(value)) fail(column, "is no number");
    return value;
}

float CsvRows::coordinate(size_t column) const {
    float value = 0;
    if (!parse(cell(column), value) || std::isinf(value)) fail(column, "is no number");
    return value;
}

int64_t CsvRows::whole_number(size_t column) const {
    int64_t value = 0;
    if (!parse(cell(column), value)) fail(column, "is no whole number");
    return value;
}

void CsvRows::fail(const std::string& fault) const {
    throw Failure(file_ + ", line " + std::to_string(line_) + ": " + fault);
}

void CsvRows::fail(size_t column, const std::string& fault) const {
    fail("column " + std::to_string(column + 1) + ": '" + std::string(cell(column)) + "' " + fault);
}

}  // namespace vfit::tools
