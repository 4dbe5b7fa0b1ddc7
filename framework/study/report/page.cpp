// SPDX-License-Identifier: MIT
#include <framework/study/report/chart.h>
#include <framework/study/report/page.h>

#include <fmt/format.h>

namespace lodestir {
namespace {

constexpr const char* style = R"(
body { font: 15px/1.5 system-ui, sans-serif; color: #222; max-width: 1280px; margin: 2em auto; padding: 0 1.5em }
h1 { font-size: 1.6em; margin-bottom: 0 } h2 { margin-top: 2em; border-bottom: 1px solid #ccc } .note { color: #555; max-width: 60em }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; margin: 1em 0 }
th, td { padding: 2px 12px; text-align: right; border-bottom: 1px solid #e6e6e6; white-space: nowrap } th { font-weight: 600; border-bottom-color: #888 }
th:first-child, td:first-child { text-align: left } .pm { color: #777 } .charts { display: flex; flex-wrap: wrap; gap: 1.5em }
svg { max-width: 100%; height: auto; font-family: system-ui, sans-serif } svg .title { font-size: 14px; font-weight: 600 }
.unbiased { color: #00734f; font-weight: 600 } .biased { color: #c03a00; font-weight: 600 } .inconclusive { color: #8a6d00; font-weight: 600 }
td.reason { text-align: left; white-space: normal } .maps { display: flex; flex-wrap: wrap; gap: 1.5em } .maps figure { margin: 0 }
figcaption { font-size: 13px }
svg .tick { font-size: 12px; fill: #444 } svg .label { font-size: 13px; fill: #222 } svg .grid { stroke: #e4e4e4 } svg .frame { stroke: #444; fill: none }
)";

}  // namespace

std::string pageHtml(const std::string& title, const std::string& about, const std::string& body) {
    return fmt::format(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\">\n"
        "<title>{0}</title><style>{1}</style></head><body>\n<h1>{0}</h1>\n<p>{2}</p>\n{3}</body></html>\n",
        escapeHtml(title), style, escapeHtml(about), body);
}

}  // namespace lodestir
