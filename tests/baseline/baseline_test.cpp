// What scenes and random bodies end with, against what they ended with when baseline.txt was written. In every run of
// the tests a few of them; `./dev baseline` takes all and prints what differs, `./dev baseline --write` writes the file
// anew.
#include <gtest/gtest.h>

#include <bit>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include <fmt/ostream.h>

#include "cases.hpp"
#include "tests/support/folder.hpp"

namespace signorini::test {
namespace {

const std::filesystem::path file = SIGNORINI_SOURCE_DIR "/tests/baseline/baseline.txt";

/// FNV-1a.
class Hash {
 public:
  void add(std::uint64_t word) {
    for (int k = 0; k < 64; k += 8) value_ = (value_ ^ (word >> k & 0xff)) * 0x100000001b3u;
  }
  void add(const std::string& text) {
    for (const char c : text) add(static_cast<unsigned char>(c));
  }
  std::string text() const { return fmt::format("{:08x}", value_ >> 32 ^ (value_ & 0xffffffffu)); }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

/// What has to be the same for the same bits: the processor, by what it can do, and the compiler.
std::string made_on() {
  std::string line, model;
  Hash flags;
  for (std::ifstream cpu("/proc/cpuinfo"); std::getline(cpu, line);) {
    if (line.starts_with("model name")) model = line.substr(line.find(':') + 2);
    if (!line.starts_with("flags")) continue;
    flags.add(line);
    break;
  }
  return fmt::format("{} with flags {}, {}", model, flags.text(), SIGNORINI_BUILT_BY);
}

/// What a case ends with: a line of the file.
struct Line {
  std::string name;
  int exit = 0;
  int iterations = 0;  ///< of all steps
  std::string bits;    ///< of the displacements, or of the message where there are none
  /// Sums over all steps: energies; lengths of the forces of obstacles, along their normals and across, and of fixes;
  /// work of friction.
  std::array<double, 5> numbers{};
  double rounding =
      0;  ///< what stiffnesses that differ by rounding change of the numbers; infinite: iterations or exit
};

double length(const std::vector<double>& force) {
  double sum = 0;
  for (const double f : force) sum += f * f;
  return std::sqrt(sum);
}

Line solve(const Case& one, double nudge = 1) {
  const Outcome outcome = solve_scene([&] { return nudged(one.read(), nudge); });
  Line out;
  out.name = one.name;
  out.exit = static_cast<int>(outcome.exit);
  for (const StepReport& step : outcome.report.steps) {
    out.iterations += step.summary.iterations;
    out.numbers[0] += step.summary.energy;
    for (const ContactReport& c : step.contact) {
      out.numbers[1] += length(c.normal_force);
      out.numbers[2] += length(c.tangential_force);
      out.numbers[4] += c.dissipated_in_step;
    }
    for (const ForceReport& f : step.reactions) out.numbers[3] += length(f.force);
  }
  Hash hash;
  for (const double u : outcome.u) hash.add(std::bit_cast<std::uint64_t>(u));
  if (outcome.u.empty()) hash.add(outcome.message);
  out.bits = hash.text();
  return out;
}

std::string text(const Line& line) {
  std::string out = fmt::format("{} {} {} {}", line.name, line.exit, line.iterations, line.bits);
  for (const double x : line.numbers) out += fmt::format(" {:.12g}", x);
  return out + fmt::format(" {:.0e}", line.rounding);
}

struct Baseline {
  std::string made_on;
  std::map<std::string, Line> lines;
};

Baseline read() {
  Baseline out;
  std::string row, rounding;
  for (std::ifstream in(file); std::getline(in, row);) {
    if (row.starts_with("# made on ")) out.made_on = row.substr(10);
    if (row.starts_with('#')) continue;
    Line line;
    std::istringstream words(row);
    words >> line.name >> line.exit >> line.iterations >> line.bits;
    for (double& x : line.numbers) words >> x;
    words >> rounding;
    line.rounding = std::stod(rounding);
    out.lines[line.name] = line;
  }
  return out;
}

/// By how much numbers differ: forces relative to the largest one, energies and work to themselves.
double change(const Line& was, const Line& now) {
  if (was.exit != now.exit || std::abs(was.iterations - now.iterations) > 1) return infinity;
  const double force = std::max({was.numbers[1], was.numbers[2], was.numbers[3]});
  double most = 0;
  for (std::size_t k = 0; k < was.numbers.size(); ++k) {
    const double by = std::abs(was.numbers[k] - now.numbers[k]);
    if (by != 0) most = std::max(most, by / (k >= 1 && k <= 3 ? force : std::abs(was.numbers[k])));
  }
  return most;
}

enum Difference { none, bits_only, rounding, more };

/// Another iteration more or less changes forces by the solver's tolerance, and some results are rounding and nothing
/// else: what is allowed is a multiple of what rounding was seen to do to the case.
Difference difference(const Line& was, const Line& now, bool compare_bits) {
  // On another processor another iteration more or less is likely, which moves forces by up to 1e-6.
  const double always = compare_bits ? 1e-10 : 1e-6, multiple = 100;
  const double by = change(was, now);
  if (std::isinf(was.rounding) || by <= always || by <= multiple * was.rounding) {
    if (was.iterations != now.iterations || !(by <= always)) return rounding;
    return compare_bits && was.bits != now.bits ? bits_only : none;
  }
  return more;
}

class Baselines : public Folder {
 protected:
  /// Prints what differs; fails where it is more than what rounding does.
  void compare(bool all) const {
    const Baseline baseline = read();
    const bool same_machine = baseline.made_on == made_on();
    std::array<int, 4> count{};
    for (const Case& one : cases(folder_)) {
      if (!all && !one.quick) continue;
      ASSERT_TRUE(baseline.lines.contains(one.name)) << one.name << ": run ./dev baseline --write";
      const Line& was = baseline.lines.at(one.name);
      const Line now = solve(one);
      const Difference d = difference(was, now, same_machine);
      ++count[d];
      if (d == more) ADD_FAILURE() << "was " << text(was) << "\nnow " << text(now);
      if (d == bits_only && all) fmt::print("bits only: {}\n", now.name);
      if (d == rounding && all) fmt::print("within rounding, was {}\n                  now {}\n", text(was), text(now));
    }
    fmt::print("{} cases as they were{}, {} differ by bits only, {} by rounding or an iteration, {} by more\n",
               count[none],
               same_machine ? "" : " (bits are not compared: the file is from another processor or compiler)",
               count[bits_only], count[rounding], count[more]);
  }

  void write() const {
    std::ofstream out(file);
    fmt::print(out, "# made on {}\n# case, exit, iterations, bits, energy, normal and tangential forces, reactions, ",
               made_on());
    fmt::print(out, "work of friction, change by rounding\n");
    for (const Case& one : cases(folder_)) {
      Line line = solve(one);
      for (const double nudge : {1 + 0x1p-51, 1 - 0x1p-50})
        line.rounding = std::max(line.rounding, change(line, solve(one, nudge)));
      fmt::print(out, "{}\n", text(line));
    }
  }
};

TEST_F(Baselines, AreKept) {
  const char* wanted = std::getenv("BASELINE");
  if (wanted && std::string_view(wanted) == "write") return write();
  compare(wanted != nullptr);
}

}  // namespace
}  // namespace signorini::test
