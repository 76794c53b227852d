#include "size/size_chart.h"

#include <algorithm>

#include "anthropometry/measure_keys.h"
#include "core/error.h"
#include "core/json.h"
#include "size/printed_ranges.h"

namespace vfit {

namespace {

constexpr int kVersion = 1;
constexpr size_t kLongestName = 31;  // vfit_size.label and vfit_size_row.garment_kind hold 32 bytes
constexpr size_t kMaxRows = 4096;    // of a garment

/// What a number of the chart is worth in the measure's own unit.
struct Units {
    float length_m = 0.01f, mass_kg = 1.0f;
    float of(const std::string& key) const { return is_mass(key) ? mass_kg : length_m; }
};

const Json& field(const Json& object, const char* name, Json::value_t type, const char* type_name,
                  std::string_view where) {
    const auto it = object.find(name);
    if (it == object.end()) fail(VFIT_ERROR_DATA, "size chart: ", where, " has no \"", name, "\"");
    if (it->type() != type)
        fail(VFIT_ERROR_DATA, "size chart: \"", name, "\" of ", where, " is not ", type_name);
    return *it;
}

const Json& array_field(const Json& object, const char* name, std::string_view where) {
    const Json& array = field(object, name, Json::value_t::array, "a list", where);
    if (array.empty()) fail(VFIT_ERROR_DATA, "size chart: \"", name, "\" of ", where, " is empty");
    return array;
}

const std::string& string_field(const Json& object, const char* name, std::string_view where) {
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

/// The labels of a garment or an axis, in the chart's order; their ranges follow.
std::vector<SizeRow> parse_labels(const Json& sizes, const std::string& where) {
    if (sizes.size() > kMaxRows)
        fail(VFIT_ERROR_DATA, "size chart: ", where, " has more than ", kMaxRows, " sizes");
    std::vector<SizeRow> rows;
    for (const Json& item : sizes) {
        require_object(item, text("a size of ", where));
        const std::string label = short_name(item, "label", text("a size of ", where));
        for (const SizeRow& other : rows)
            if (other.label == label)
                fail(VFIT_ERROR_DATA, "size chart: ", where, ", label ", label, " stands twice");
        rows.push_back({label, {}});
    }
    return rows;
}

/// `range` may be null where the garment has one label: it then serves everyone.
PrintedRange parse_range(const Json* range, const std::string& key, const Units& units,
                         const std::string& label, const std::string& place, size_t label_count) {
    if (range) return read_printed_range(*range, key, units.of(key), label, place);
    if (label_count > 1) fail(VFIT_ERROR_DATA, "size chart: ", place, " has no range");
    return {label, place, 0.0, 0.0, true, true};
}

const Json* find_field(const Json& object, const std::string& name) {
    const auto it = object.find(name);
    return it == object.end() ? nullptr : &*it;
}

void require_known_ranges(const Json& ranges, const std::vector<std::string>& measures,
                          const std::string& place) {
    for (const auto& range : ranges.items())
        if (std::find(measures.begin(), measures.end(), range.key()) == measures.end())
            fail(VFIT_ERROR_DATA, "size chart: ", place, " gives a range of \"", range.key(),
                 "\", which the garment's measures do not name");
}

/// A row of labels, each with a range of every measure.
void parse_list(const Json& item, const Units& units, const std::string& where, GarmentSizes& garment) {
    const Json& sizes = array_field(item, "sizes", where);
    if (sizes.size() > 1 || item.contains("measures")) garment.measures = parse_measures(item, where);
    garment.sizes = parse_labels(sizes, where);
    const Json none = Json::object();
    std::vector<const Json*> ranges;
    for (size_t i = 0; i < sizes.size(); ++i) {
        const std::string place = text(where, ", label ", garment.sizes[i].label);
        ranges.push_back(sizes.size() == 1 && !sizes[i].contains("ranges")
                             ? &none
                             : &field(sizes[i], "ranges", Json::value_t::object, "an object", place));
        require_known_ranges(*ranges.back(), garment.measures, place);
    }
    for (const std::string& key : garment.measures) {
        std::vector<PrintedRange> printed;
        for (size_t i = 0; i < sizes.size(); ++i) {
            const std::string& label = garment.sizes[i].label;
            printed.push_back(parse_range(find_field(*ranges[i], key), key, units, label,
                                          text(where, ", label ", label, ", ", key), sizes.size()));
        }
        const auto resolved = ranges_of(printed, key, units.of(key));
        for (size_t i = 0; i < sizes.size(); ++i) garment.sizes[i].ranges.push_back(resolved[i]);
    }
}

void require_new_measure(const std::string& key, const std::string& where, const GarmentSizes& garment) {
    if (!is_measure(key))
        fail(VFIT_ERROR_DATA, "size chart: ", where, " uses the unknown measure \"", key, "\"");
    if (std::find(garment.measures.begin(), garment.measures.end(), key) != garment.measures.end())
        fail(VFIT_ERROR_DATA, "size chart: ", where, " names the measure \"", key, "\" twice");
}

/// The labels of one axis, each with its one range.
std::vector<SizeRow> parse_axis(const Json& axis, const std::string& key, const Units& units,
                                const std::string& place) {
    const Json& sizes = array_field(axis, "sizes", place);
    std::vector<SizeRow> steps = parse_labels(sizes, place);
    std::vector<PrintedRange> printed;
    for (size_t i = 0; i < sizes.size(); ++i)
        printed.push_back(parse_range(find_field(sizes[i], "range"), key, units, steps[i].label,
                                      text(place, ", label ", steps[i].label), sizes.size()));
    const auto resolved = ranges_of(printed, key, units.of(key));
    for (size_t i = 0; i < steps.size(); ++i) steps[i].ranges = {resolved[i]};
    return steps;
}

/// "W32" and "L34" of two axes, each of one measure, make the label "W32/L34".
void parse_axes(const Json& item, const Units& units, const std::string& where, GarmentSizes& garment) {
    std::string between;
    if (item.contains("between")) between = string_field(item, "between", where);
    std::vector<SizeRow> rows = {{}};
    for (const Json& axis : array_field(item, "axes", where)) {
        require_object(axis, text("an axis of ", where));
        const std::string& key = string_field(axis, "measure", text("an axis of ", where));
        require_new_measure(key, where, garment);
        const std::vector<SizeRow> steps = parse_axis(axis, key, units, text(where, ", axis ", key));
        if (rows.size() * steps.size() > kMaxRows)
            fail(VFIT_ERROR_DATA, "size chart: ", where, " has more than ", kMaxRows, " sizes");
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

/// The steps of a table's side, from the values in the middle of its rows or columns.
std::vector<MeasureRange> parse_side(const Json& table, const char* name, const Units& units,
                                     const std::string& where, GarmentSizes& garment) {
    const Json& side = field(table, name, Json::value_t::object, "an object", where);
    const std::string place = text(where, ", ", name);
    const std::string& key = string_field(side, "measure", place);
    require_new_measure(key, where, garment);
    garment.measures.push_back(key);
    const Json& values = array_field(side, "values", place);
    if (values.size() < 2)
        fail(VFIT_ERROR_DATA, "size chart: \"values\" of ", place, " holds fewer than two");
    std::vector<PrintedRange> printed;
    for (const Json& v : values) {
        if (!v.is_number()) fail(VFIT_ERROR_DATA, "size chart: a value of ", place, " is not a number");
        const std::string value = v.dump();
        printed.push_back(
            read_printed_range(v, key, units.of(key), value, text(place, ", ", key, ", ", value)));
        if (printed.size() > 1 && !(printed.back().low > printed[printed.size() - 2].low))
            fail(VFIT_ERROR_DATA, "size chart: the values of ", place, " do not ascend");
    }
    return ranges_of(printed, key, units.of(key));
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
    if (rows.size() * columns.size() > kMaxRows)
        fail(VFIT_ERROR_DATA, "size chart: ", where, " has more than ", kMaxRows, " sizes");
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
        parse_list(item, units, where, garment);
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
