#include "csv_file.h"

#include <charconv>
#include <cmath>

namespace recording {

namespace {

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\r'))
        text.remove_suffix(1);
    return text;
}

/// Characters after the decimal point, or all of them where there is none.
size_t tail(std::string_view field) {
    const size_t point = field.find('.');
    return point == std::string_view::npos ? field.size() : field.size() - point - 1;
}

bool parse(std::string_view field, double& value) {
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    return error == std::errc() && end == field.data() + field.size() && std::isfinite(value);
}

}  // namespace

CsvFile::CsvFile(const std::filesystem::path& path) : name_(path.string()), file_(path, std::ios::binary) {
    if (!file_) fail(VFIT_ERROR_IO, name_, ": cannot be read");
    if (!read_line()) fail(VFIT_ERROR_DATA, name_, ": has no header line");
    split();
    columns_.assign(fields_.begin(), fields_.end());
    if (columns_.front() != "frame") refuse("the first column is '", columns_.front(), "', not 'frame'");
    first_row_ = file_.tellg();
}

void CsvFile::rewind() {
    file_.clear();
    if (first_row_ == std::streampos(-1)) {
        file_.setstate(std::ios::eofbit);  // a header without rows, cut before its line end
        return;
    }
    file_.seekg(first_row_);
    line_number_ = 1;
    last_field_tail_ = 0;
}

bool CsvFile::read_line() {
    if (!file_ || file_.eof()) return false;
    file_.getline(line_.data(), kMaxLine);
    const auto read = static_cast<size_t>(file_.gcount());
    ++line_number_;
    if (file_.bad()) fail(VFIT_ERROR_IO, name_, ": cannot be read on");
    if (file_.fail() && !file_.eof()) refuse("is longer than ", kMaxLine - 1, " bytes");
    ended_ = !file_.eof();
    text_ = trimmed({line_.data(), ended_ ? read - 1 : read});
    return ended_ || read > 0;
}

void CsvFile::split() {
    fields_.clear();
    std::string_view rest = text_;
    for (size_t comma; (comma = rest.find(',')) != std::string_view::npos; rest.remove_prefix(comma + 1))
        fields_.push_back(trimmed(rest.substr(0, comma)));
    fields_.push_back(trimmed(rest));
}

bool CsvFile::is_whole() const {
    double value;
    if (fields_.size() != columns_.size()) return false;
    const std::string_view last = fields_.back();
    // "2.9402" may have been cut to "2.94", and nobody could tell but by the row before.
    return parse(last, value) && tail(last) >= last_field_tail_;
}

bool CsvFile::next() {
    do {
        if (!read_line()) return false;
    } while (text_.empty());
    split();
    if (!ended_ && !is_whole()) return false;
    if (fields_.size() != columns_.size())
        refuse("has ", fields_.size(), " fields, the header has ", columns_.size());
    last_field_tail_ = tail(fields_.back());
    return true;
}

double CsvFile::number(size_t column) const {
    double value = 0.0;
    if (!parse(fields_[column], value))
        refuse("column ", columns_[column], ": '", fields_[column].substr(0, 32), "' is not a finite number");
    return value;
}

int64_t CsvFile::integer(size_t column, int64_t low) const {
    const std::string_view field = fields_[column];
    int64_t value = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size())
        refuse("column ", columns_[column], ": '", field.substr(0, 32), "' is not a whole number");
    if (value < low) refuse("column ", columns_[column], ": ", value, " is less than ", low);
    return value;
}

}  // namespace recording
