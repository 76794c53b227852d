#include "size/size_chart.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/json.h"
#include "measure/measure_keys.h"

namespace vfit {

namespace {

constexpr int kVersion = 1;
constexpr size_t kLongestName = 31;  // vfit_size.label and vfit_size_row.garment_kind hold 32 bytes
constexpr float kLongest_m = 10.0f;  // no body measure is longer: the unit is wrong
constexpr float kHeaviest_kg = 700.0f;
constexpr float kRounding = 1e-5f;  // 94 cm is not exact in binary
constexpr size_t kMostRows = 4096;  // of a garment

/// What a number of the chart is worth in the measure's own unit.
struct Units {
    float length_m = 0.01f, mass_kg = 1.0f;
    float of(const std::string& key) const { return is_mass(key) ? mass_kg : length_m; }
};

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
        if (!is_measure(key))
            fail(VFIT_ERROR_DATA, "size chart: ", where, " uses the unknown measure \"", key, "\"");
        if (std::find(measures.begin(), measures.end(), key) != measures.end())
            fail(VFIT_ERROR_DATA, "size chart: ", where, " names the measure \"", key, "\" twice");
        measures.push_back(key);
    }
    return measures;
}

MeasureRange parse_bounds(const Json& pair, const std::string& key, const Units& units,
                          const std::string& place) {
    if (!pair.is_array() || pair.size() != 2 || !pair[0].is_number() || !pair[1].is_number())
        fail(VFIT_ERROR_DATA, "size chart: the range of ", place, " is not [low, high]");
    const double low = pair[0].get<double>() * units.of(key), high = pair[1].get<double>() * units.of(key);
    const float most = is_mass(key) ? kHeaviest_kg : kLongest_m;
    if (!std::isfinite(low) || !std::isfinite(high) || low < 0.0 || high > most)
        fail(VFIT_ERROR_DATA, "size chart: the range of ", place, " is not within 0 and ", most,
             is_mass(key) ? " kg" : " m");
    if (low >= high)
        fail(VFIT_ERROR_DATA, "size chart: the range of ", place, " is empty: low is not below high");
    return {key, float(low), float(high)};
}

MeasureRange parse_range(const Json& ranges, const std::string& key, const Units& units,
                         const std::string& where) {
    const std::string place = text(where, ", ", key);
    const auto it = ranges.find(key);
    if (it == ranges.end()) fail(VFIT_ERROR_DATA, "size chart: ", place, " has no range");
    return parse_bounds(*it, key, units, place);
}

/// A range that follows another: above it, and apart from it.
void check_order(const MeasureRange& before, const MeasureRange& after, const std::string& place,
                 const std::string& label_before) {
    if (after.low < before.low + kRounding || after.high < before.high + kRounding)
        fail(VFIT_ERROR_DATA, "size chart: ", place, " is not above that of label ", label_before,
             ": sizes must stand in ascending order");
    if (after.low < before.high - kRounding)
        fail(VFIT_ERROR_DATA, "size chart: ", place, " overlaps that of label ", label_before);
}

SizeRow parse_row(const Json& item, const GarmentSizes& garment, const Units& units,
                  const std::string& where) {
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
        row.ranges.push_back(parse_range(ranges, key, units, place));

    if (!garment.sizes.empty()) {
        const SizeRow& before = garment.sizes.back();
        for (size_t i = 0; i < row.ranges.size(); ++i)
            check_order(before.ranges[i], row.ranges[i], text(place, ", ", row.ranges[i].key), before.label);
    }
    return row;
}

/// "W32" and "L34" of two axes, each of one measure, make the label "W32/L34".
void parse_axes(const Json& item, const Units& units, const std::string& where, GarmentSizes& garment) {
    std::string between;
    if (item.contains("between")) between = string_field(item, "between", where);
    std::vector<SizeRow> rows = {{}};
    for (const Json& axis : array_field(item, "axes", where)) {
        require_object(axis, text("an axis of ", where));
        const std::string& key = string_field(axis, "measure", text("an axis of ", where));
        const std::string place = text(where, ", axis ", key);
        if (!is_measure(key))
            fail(VFIT_ERROR_DATA, "size chart: ", where, " uses the unknown measure \"", key, "\"");
        if (std::find(garment.measures.begin(), garment.measures.end(), key) != garment.measures.end())
            fail(VFIT_ERROR_DATA, "size chart: ", where, " names the measure \"", key, "\" twice");
        std::vector<SizeRow> steps;
        for (const Json& step : array_field(axis, "sizes", place)) {
            require_object(step, text("a size of ", place));
            SizeRow one{short_name(step, "label", text("a size of ", place)), {}};
            const std::string at = text(place, ", label ", one.label);
            for (const SizeRow& other : steps)
                if (other.label == one.label) fail(VFIT_ERROR_DATA, "size chart: ", at, " stands twice");
            one.ranges = {
                parse_bounds(field(step, "range", Json::value_t::array, "[low, high]", at), key, units, at)};
            if (!steps.empty()) check_order(steps.back().ranges[0], one.ranges[0], at, steps.back().label);
            steps.push_back(std::move(one));
        }
        if (rows.size() * steps.size() > kMostRows)
            fail(VFIT_ERROR_DATA, "size chart: ", where, " has more than ", kMostRows, " sizes");
        std::vector<SizeRow> longer;
        for (const SizeRow& row : rows)
            for (const SizeRow& step : steps) {
                longer.push_back(row);
                longer.back().label += (row.ranges.empty() ? "" : between) + step.label;
                longer.back().ranges.push_back(step.ranges[0]);
                if (longer.back().label.size() > kLongestName)
                    fail(VFIT_ERROR_DATA, "size chart: label ", longer.back().label, " of ", where,
                         " is longer than ", kLongestName, " bytes");
            }
        rows = std::move(longer);
        garment.measures.push_back(key);
    }
    garment.sizes = std::move(rows);
}

/// The steps of a table's side, from the values in the middle of its rows or columns: each reaches halfway to
/// the next.
std::vector<MeasureRange> parse_side(const Json& table, const char* name, const Units& units,
                                     const std::string& where, GarmentSizes& garment) {
    const Json& side = field(table, name, Json::value_t::object, "an object", where);
    const std::string place = text(where, ", ", name);
    const std::string& key = string_field(side, "measure", place);
    if (!is_measure(key))
        fail(VFIT_ERROR_DATA, "size chart: ", where, " uses the unknown measure \"", key, "\"");
    if (std::find(garment.measures.begin(), garment.measures.end(), key) != garment.measures.end())
        fail(VFIT_ERROR_DATA, "size chart: ", where, " names the measure \"", key, "\" twice");
    garment.measures.push_back(key);
    const Json& values = array_field(side, "values", place);
    if (values.size() < 2)
        fail(VFIT_ERROR_DATA, "size chart: \"values\" of ", place, " holds fewer than two");
    std::vector<double> middle;
    for (const Json& v : values) {
        if (!v.is_number()) fail(VFIT_ERROR_DATA, "size chart: a value of ", place, " is not a number");
        if (!middle.empty() && !(v.get<double>() > middle.back()))
            fail(VFIT_ERROR_DATA, "size chart: the values of ", place, " do not ascend");
        middle.push_back(v.get<double>());
    }
    std::vector<MeasureRange> steps;
    for (size_t i = 0; i < middle.size(); ++i) {
        const double half_below = 0.5 * (i ? middle[i] - middle[i - 1] : middle[1] - middle[0]);
        const double half_above =
            0.5 * (i + 1 < middle.size() ? middle[i + 1] - middle[i] : middle[i] - middle[i - 1]);
        steps.push_back(parse_bounds(Json::array({middle[i] - half_below, middle[i] + half_above}), key,
                                     units, text(place, ", ", key)));
    }
    return steps;
}

/// Labels by two measures, as on the back of a packet: one row a step of the first, one label a step of the
/// second.
void parse_table(const Json& item, const Units& units, const std::string& where, GarmentSizes& garment) {
    const Json& table = field(item, "table", Json::value_t::object, "an object", where);
    const auto rows = parse_side(table, "rows", units, where, garment);
    const auto columns = parse_side(table, "columns", units, where, garment);
    const Json& labels = array_field(table, "labels", where);
    if (labels.size() != rows.size())
        fail(VFIT_ERROR_DATA, "size chart: \"labels\" of ", where, " has ", labels.size(), " rows, not ",
             rows.size());
    if (rows.size() * columns.size() > kMostRows)
        fail(VFIT_ERROR_DATA, "size chart: ", where, " has more than ", kMostRows, " sizes");
    for (size_t r = 0; r < rows.size(); ++r) {
        if (!labels[r].is_array() || labels[r].size() != columns.size())
            fail(VFIT_ERROR_DATA, "size chart: row ", r + 1, " of \"labels\" of ", where,
                 " is not a list of ", columns.size());
        for (size_t c = 0; c < columns.size(); ++c) {
            const std::string place = text(where, ", row ", r + 1);
            garment.sizes.push_back(
                {short_name(Json{{"label", labels[r][c]}}, "label", place), {rows[r], columns[c]}});
        }
    }
}

/// How much each measure counts where they disagree: 1, or as "weights" says.
std::vector<float> parse_weights(const Json& garment, const std::vector<std::string>& measures,
                                 const std::string& where) {
    std::vector<float> out(measures.size(), 1.0f);
    if (!garment.contains("weights")) return out;
    for (const auto& [key, value] :
         field(garment, "weights", Json::value_t::object, "an object", where).items()) {
        const auto at = std::find(measures.begin(), measures.end(), key);
        if (at == measures.end())
            fail(VFIT_ERROR_DATA, "size chart: \"weights\" of ", where, " names \"", key,
                 "\", which its measures do not");
        const float weight = value.is_number() ? value.get<float>() : 0.0f;
        if (!(weight > 0.0f && weight <= 100.0f))
            fail(VFIT_ERROR_DATA, "size chart: the weight of ", key, " of ", where,
                 " is not above 0 and at most 100");
        out[size_t(at - measures.begin())] = weight;
    }
    return out;
}

GarmentSizes parse_garment(const Json& item, const std::vector<GarmentSizes>& before, const Units& units) {
    require_object(item, "a garment");
    GarmentSizes garment;
    garment.kind = short_name(item, "kind", "a garment");
    const std::string where = text("garment ", garment.kind);
    for (const GarmentSizes& other : before)
        if (other.kind == garment.kind) fail(VFIT_ERROR_DATA, "size chart: ", where, " stands twice");
    if (int(item.contains("sizes")) + int(item.contains("axes")) + int(item.contains("table")) > 1)
        fail(VFIT_ERROR_DATA, "size chart: ", where,
             " has more than one of \"sizes\", \"axes\" and \"table\"");
    if (item.contains("axes")) {
        parse_axes(item, units, where, garment);
    } else if (item.contains("table")) {
        parse_table(item, units, where, garment);
    } else {
        garment.measures = parse_measures(item, where);
        for (const Json& size : array_field(item, "sizes", where))
            garment.sizes.push_back(parse_row(size, garment, units, where));
    }
    garment.weights = parse_weights(item, garment.measures, where);
    for (const SizeRow& row : garment.sizes)
        if (std::find(garment.labels.begin(), garment.labels.end(), row.label) == garment.labels.end())
            garment.labels.push_back(row.label);
    return garment;
}

/// "unit" is of lengths; "mass_unit" of masses, kilograms where it is left out.
Units parse_units(const Json& chart) {
    Units units;
    const std::string& length = string_field(chart, "unit", "the chart");
    if (length != "cm" && length != "in")
        fail(VFIT_ERROR_DATA, "size chart: unknown unit \"", length, "\"; known: cm, in");
    if (length == "in") units.length_m = 0.0254f;
    if (chart.contains("mass_unit")) {
        const std::string& mass = string_field(chart, "mass_unit", "the chart");
        if (mass != "kg" && mass != "lb")
            fail(VFIT_ERROR_DATA, "size chart: unknown mass_unit \"", mass, "\"; known: kg, lb");
        if (mass == "lb") units.mass_kg = 0.45359237f;
    }
    return units;
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
        fail(VFIT_ERROR_VERSION, "size chart: version ", version->get<int64_t>(),
             " is unknown; this library reads ", kVersion);

    SizeChart result;
    result.name_ = string_field(chart, "name", "the chart");
    if (chart.contains("source")) result.source_ = string_field(chart, "source", "the chart");
    const Units units = parse_units(chart);
    for (const Json& garment : array_field(chart, "garments", "the chart"))
        result.garments_.push_back(parse_garment(garment, result.garments_, units));
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
