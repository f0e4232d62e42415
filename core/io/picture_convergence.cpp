#include <fmt/format.h>

#include <algorithm>

#include "core/io/picture.hpp"

namespace signorini {
namespace {

/// Zero and infinity cannot be drawn on a logarithmic axis.
bool is_drawn(double value) { return value > 0 && value < infinity; }

/// gnuplot leaves out what is no number.
std::string logarithmic(double value) { return is_drawn(value) ? fmt::format("{}", value) : "nan"; }

/// gnuplot finds no ranges by itself where there is nothing to draw.
std::string ranges(const std::vector<IterationRecord>& history) {
  const bool drawn = std::ranges::any_of(history, [](const IterationRecord& record) {
    return is_drawn(record.residual) || is_drawn(record.algebraic_error);
  });
  return fmt::format("set xrange [0.5:{}]\nset yrange [{}]\nset y2range [0:{}]\n", history.empty() ? "1.5" : "*",
                     drawn ? "*:*" : "1e-16:1", history.empty() ? "1" : "*");
}

constexpr const char* script = R"(
set xlabel 'iteration'
set ylabel 'relative to the solution'
set y2label 'nodes in contact'
set logscale y
set format y '10^{%T}'
set ytics nomirror
set y2tics
set grid xtics ytics lc '#dddddd'
set key below
set style data linespoints
plot 'data' using 1:2 title 'natural residual' lc '#2166ac' lw 2 pt 7 ps 0.7, \
     'data' using 1:3 title 'algebraic error' lc '#b2182b' lw 2 pt 5 ps 0.7, \
     'data' using 1:4 axes x1y2 title 'nodes in contact' lc '#888888' dt 2 pt 6 ps 0.7
)";
}  // namespace

void draw_convergence(Gnuplot& gnuplot, const std::filesystem::path& picture,
                      const std::vector<IterationRecord>& history) {
  std::string data;
  for (const IterationRecord& record : history)
    data += fmt::format("{} {} {} {}\n", record.iteration, logarithmic(record.residual),
                        logarithmic(record.algebraic_error), record.contact_nodes);
  gnuplot.add_data("data", data.empty() ? "1 nan nan nan\n" : data);
  gnuplot.start(ranges(history) + script, picture, 900, 600);
}

}  // namespace signorini
