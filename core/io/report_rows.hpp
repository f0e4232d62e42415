#pragma once
#include "core/io/report.hpp"
#include "core/io/report_table.hpp"

namespace signorini::report {

Json whole_report(const Report& report);
Json qp_report(const QpReport& report);

/// What they hold.
const ObjectSpec& report_spec();
const ObjectSpec& qp_spec();

}  // namespace signorini::report
