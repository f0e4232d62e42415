#pragma once
#include <string>

namespace signorini {

/// docs/report.md: every key of report.json, in Markdown.
std::string report_page();

/// docs/report.schema.json: a JSON schema (draft 7) that reports of this version agree with; those of `signorini qp`
/// agree with its definition "qp".
std::string report_schema();

}  // namespace signorini
