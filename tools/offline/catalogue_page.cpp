#include "offline/catalogue.h"

#include <cctype>
#include <cstdio>
#include <cstring>
#include <map>
#include <sstream>

namespace vfit::tools {

namespace {

constexpr const char* kStyle =
    "body{font:15px/1.4 sans-serif;margin:2em;color:#222}"
    "section{display:flex;flex-wrap:wrap;gap:1em}"
    "article{width:260px;border:1px solid #ccc;border-radius:6px;padding:10px;overflow-wrap:anywhere}"
    "article.failed{border-color:#c33}article.warned{border-color:#d90}"
    "img{width:100%}h2{font-size:16px;margin:4px 0}p{margin:4px 0}small{color:#666}";

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '&')
            out += "&amp;";
        else if (c == '"')
            out += "&quot;";
        else
            out += c;
    }
    return out;
}

/// As a path in a link (RFC 3986).
std::string linked(const std::string& path) {
    std::string out;
    for (const char c : path) {
        const auto byte = static_cast<unsigned char>(c);
        char code[4];
        if (std::isalnum(byte) || std::strchr("-._~/", c))
            out += c;
        else
            std::snprintf(code, sizeof code, "%%%02X", byte), out += code;
    }
    return out;
}

template <typename... T>
std::string text(const T&... parts) {
    std::ostringstream out;
    (out << ... << parts);
    return out.str();
}

double rounded(double seconds) { return double(int(seconds * 10.0 + 0.5)) / 10.0; }

std::string garment_lines(const Json& g) {
    std::string out =
        text("<p>", escaped(g["kind"].get<std::string>()), ", ", g["vertices"].get<int>(), " vertices");
    if (!g["sizes"].empty()) {
        out += ", sizes";
        for (const Json& size : g["sizes"]) out += " " + escaped(size.get<std::string>());
    }
    if (g.contains("hangs_on"))
        out += text("; worn from the ", g["hangs_on"].get<std::string>(), ", ",
                    g["skin_crossings"].get<int>() + g["self_crossings"].get<int>(), " crossings");
    out += "</p>";
    if (g.contains("warnings"))
        for (const Json& warning : g["warnings"])
            out += "<p><small>" + escaped(warning.get<std::string>()) + "</small></p>";
    return out;
}

std::string article(const Json& row) {
    const std::string state = row["state"];
    bool warned = false;
    std::string inside;
    if (row.contains("picture")) {
        const std::string picture = linked(row["picture"].get<std::string>());
        inside += "<a href=\"" + picture + "\"><img loading=\"lazy\" src=\"" + picture + "\" alt=\"\"></a>";
    }
    inside += "<h2>" + escaped(row["name"].get<std::string>()) + "</h2>";
    if (state == "cooked")
        for (const Json& g : row["garments"]) {
            inside += garment_lines(g);
            warned = warned || (g.contains("hangs_on") &&
                                g["skin_crossings"].get<int>() + g["self_crossings"].get<int>() > 0);
        }
    else
        inside += "<p>" + escaped(row["error"].get<std::string>()) + "</p>";
    inside += text("<p><small>", escaped(row["design"].get<std::string>()), ", ",
                   rounded(row["seconds"].get<double>()), " s</small></p>");
    const char* kind = state != "cooked" ? "failed" : warned ? "warned" : "cooked";
    return text("<article class=\"", kind, "\">", inside, "</article>\n");
}

}  // namespace

std::string catalogue_page(const Json& report) {
    std::map<std::string, int> count;
    std::string articles;
    for (const Json& row : report["designs"]) {
        const std::string state = row["state"];
        ++count[state == "over_time" || state == "crashed" ? "failed" : state];
        if (row.contains("name")) articles += article(row);
    }
    return text(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Garments</title><style>",
        kStyle, "</style></head><body>\n<h1>Garments</h1>\n<p>", count["cooked"], " cooked, ",
        count["failed"], " failed, ", count["left_out"], " no designs, ", count["waiting"],
        " not yet cooked</p>\n<section>\n", articles, "</section></body></html>\n");
}

}  // namespace vfit::tools
