#include "size/size_chart.h"

#include <algorithm>
#include <cmath>


#include "core/error.h"
#include "core/json.h"
#include "measure/measure_keys.h"

namespace vfit {

namespace {

constexpr int kVersion = 1;
constexpr size_t kLongestName = 31;   // vfit_size.label and vfit_size_row.garment_kind hold 32 bytes
constexpr float kLargest_m = 10.0f;   // no body measure is longer: the unit is wrong
constexpr float kRounding_m = 1e-5f;  // 94 cm is not exact in binary

const Json& field(const Json& object, const char* name, Json::value_t type, const char* type_name,
                  const std::string& where) {
    const auto it = object.find(name);
    if (it == object.end()) fail(VFIT_ERROR_DATA, "size chart: ", where, " has no \"", name, "\"");
    if (it->type() != type)
        fail(VFIT_ERROR_DATA, "size chart: \"", name, "\" of ", where, " is not ", type_name);
    return *it;
}

const Json& array_field(const Json& object, const char* name, const std::string& where) {
    const Json& array = field(object, name, Json::value_t::array, "a list", where);
    if (array.empty()) fail(VFIT_ERROR_DATA, "size chart: \"", name, "\" of ", where, " is empty");
    return array;
}

const std::string& string_field(const Json& object, const char* name, const std::string& where) {
    return field(object, name, Json::value_t::string, "a text", where).get_ref<const std::string&>();
}

std::string short_name(const Json& object, const char* name, const std::string& where) {
    const std::string& value = string_field(object, name, where);
    if (value.empty() || value.size() > kLongestName)
        fail(VFIT_ERROR_DATA, "size chart: \"", name, "\" of ", where, " must have 1 to ", kLongestName,
             " bytes");
    // A name with a 0 inside would end there for every reader in C, and two could be told apart no more.
    const auto control = [](char c) { return static_cast<unsigned char>(c) < 0x20; };
    if (std::any_of(value.begin(), value.end(), control))
        fail(VFIT_ERROR_DATA, "size chart: \"", name, "\" of ", where, " holds a control character");
    return value;
}

void require_object(const Json& value, const std::string& where) {
    if (!value.is_object()) fail(VFIT_ERROR_DATA, "size chart: ", where, " is not an object");
}

std::vector<std::string> parse_measures(const Json& garment, const std::string& where) {
    std::vector<std::string> measures;
    for (const Json& item : array_field(garment, "measures", where)) {
        if (!item.is_string()) fail(VFIT_ERROR_DATA, "size chart: a measure of ", where, " is not a text");
        const std::string& key = item.get_ref<const std::string&>();
        if (measure_index(key) < 0)
            fail(VFIT_ERROR_DATA, "size chart: ", where, " uses the unknown measure \"", key, "\"");
        if (std::find(measures.begin(), measures.end(), key) != measures.end())
            fail(VFIT_ERROR_DATA, "size chart: ", where, " names the measure \"", key, "\" twice");
        measures.push_back(key);
    }
    return measures;
}

MeasureRange parse_range(const Json& ranges, const std::string& key, float unit_m, const std::string& where) {
    const std::string place = text(where, ", ", key);
    const auto it = ranges.find(key);
    if (it == ranges.end()) fail(VFIT_ERROR_DATA, "size chart: ", place, " has no range");
    if (!it->is_array() || it->size() != 2 || !(*it)[0].is_number() || !(*it)[1].is_number())
        fail(VFIT_ERROR_DATA, "size chart: the range of ", place, " is not [low, high]");
    const double low = (*it)[0].get<double>() * unit_m, high = (*it)[1].get<double>() * unit_m;
    if (!std::isfinite(low) || !std::isfinite(high) || low < 0.0 || high > kLargest_m)
        fail(VFIT_ERROR_DATA, "size chart: the range of ", place, " is not within 0 and ", kLargest_m, " m");
    if (low >= high)
        fail(VFIT_ERROR_DATA, "size chart: the range of ", place, " is empty: low is not below high");
    return {key, float(low), float(high)};
}

SizeRow parse_row(const Json& item, const GarmentSizes& garment, float unit_m, const std::string& where) {
    require_object(item, text("a size of ", where));
    SizeRow row;
    row.label = short_name(item, "label", text("a size of ", where));
    const std::string place = text(where, ", label ", row.label);
    for (const SizeRow& other : garment.sizes)
        if (other.label == row.label) fail(VFIT_ERROR_DATA, "size chart: ", place, " stands twice");

    const Json& ranges = field(item, "ranges", Json::value_t::object, "an object", place);
    for (const auto& range : ranges.items())
        if (std::find(garment.measures.begin(), garment.measures.end(), range.key()) ==
            garment.measures.end())
            fail(VFIT_ERROR_DATA, "size chart: ", place, " gives a range of \"", range.key(),
                 "\", which the garment's measures do not name");
    for (const std::string& key : garment.measures)
        row.ranges.push_back(parse_range(ranges, key, unit_m, place));

    if (!garment.sizes.empty()) {
        const SizeRow& before = garment.sizes.back();
        for (size_t i = 0; i < row.ranges.size(); ++i) {
            const MeasureRange& a = before.ranges[i];
            const MeasureRange& b = row.ranges[i];
            if (b.low_m < a.low_m + kRounding_m || b.high_m < a.high_m + kRounding_m)
                fail(VFIT_ERROR_DATA, "size chart: ", place, ", ", b.key, " is not above that of label ",
                     before.label, ": sizes must stand in ascending order");
            if (b.low_m < a.high_m - kRounding_m)
                fail(VFIT_ERROR_DATA, "size chart: ", place, ", ", b.key, " overlaps that of label ",
                     before.label);
        }
    }
    return row;
}

GarmentSizes parse_garment(const Json& item, const std::vector<GarmentSizes>& before, float unit_m) {
    require_object(item, "a garment");
    GarmentSizes garment;
    garment.kind = short_name(item, "kind", "a garment");
    const std::string where = text("garment ", garment.kind);
    for (const GarmentSizes& other : before)
        if (other.kind == garment.kind) fail(VFIT_ERROR_DATA, "size chart: ", where, " stands twice");
    garment.measures = parse_measures(item, where);
    for (const Json& size : array_field(item, "sizes", where))
        garment.sizes.push_back(parse_row(size, garment, unit_m, where));
    return garment;
}

float parse_unit(const Json& chart) {
    const std::string& unit = string_field(chart, "unit", "the chart");
    if (unit == "cm") return 0.01f;
    if (unit == "in") return 0.0254f;
    fail(VFIT_ERROR_DATA, "size chart: unknown unit \"", unit, "\"; known: cm, in");
}

}  // namespace

SizeChart SizeChart::parse(std::string_view json) {
    const Json chart = parse_json(json, "size chart");
    require_object(chart, "the chart");
    const std::string& format = string_field(chart, "format", "the chart");
    if (format != "vfit-size-chart")
        fail(VFIT_ERROR_DATA, "size chart: the format is \"", format, "\", not \"vfit-size-chart\"");
    const auto version = chart.find("version");
    if (version == chart.end() || !version->is_number_integer())
        fail(VFIT_ERROR_DATA, "size chart: the chart has no whole number \"version\"");
    if (*version != kVersion)
        fail(VFIT_ERROR_VERSION, "size chart: version ", version->get<int64_t>(), " is unknown; this library reads ",
             kVersion);

    SizeChart result;
    result.name_ = string_field(chart, "name", "the chart");
    if (chart.contains("source")) result.source_ = string_field(chart, "source", "the chart");
    const float unit_m = parse_unit(chart);
    for (const Json& garment : array_field(chart, "garments", "the chart"))
        result.garments_.push_back(parse_garment(garment, result.garments_, unit_m));
    return result;
}

const GarmentSizes& SizeChart::garment(const std::string& kind) const {
    std::string known;
    for (const GarmentSizes& garment : garments_) {
        if (garment.kind == kind) return garment;
        known += text(known.empty() ? "" : ", ", garment.kind);
    }
    fail(VFIT_ERROR_ARGUMENT, "size chart \"", name_, "\" has no garment kind \"", kind,
         "\"; it has: ", known);
}

}  // namespace vfit
