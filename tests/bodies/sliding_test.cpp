#include <algorithm>
#include <array>

#include "tests/bodies/scenes.hpp"

// Bodies that slide far along each other, step by step: they find each other anew where the last step has moved them.

namespace signorini::test {
namespace {

using tables::block, tables::fix;

constexpr double friction = 0.2, press = 0.01;

std::string lower() { return block("lower", "[0, 0]", "[6, 1]", "[24, 4]") + fix("lower", "bottom", "[0, 0]"); }

/// A block on it whose left edge is at x, pressed in the first step; `way` is how far it has gone then.
std::string upper(double x, const std::string& way) {
  return block("upper", fmt::format("[{}, 1]", x), fmt::format("[{}, 1.5]", x + 1), "[5, 3]", material(2)) +
         fix("upper", "top", fmt::format("[\"{}\", {}]", way, -press));
}

std::string steps(int count, int refinements = 1) {
  return fmt::format("[steps]\ncount = {}\n[refine]\nuniform = {}\n", count, refinements);
}

std::string slides(const std::string& more = "", const char* type = "elastic_coulomb") {
  return pair("upper", "bottom", "lower", "top",
              std::string(type) == "elastic" ? more : fmt::format("friction = {}\n{}", friction, more), type);
}

const Report& solved(Driver& driver) {
  const Report& report = driver.solve();
  EXPECT_TRUE(report.converged()) << report.reason();
  return report;
}

// After each step of 0.25, which is an element of the lower block, all is as with a block that has been there from the
// start and slides by as much as it takes to slip.
TEST(Sliding, BlockFeelsTheSameWhereverItHasComeFrom) {
  constexpr int count = 9;
  Driver driver(scene_of(lower() + upper(1, "0.25 * (9 * t - 1)") + slides() + steps(count)));
  const Report& report = solved(driver);
  double slid = 0;
  for (int step = 2; step <= count; ++step) {
    SCOPED_TRACE(step);
    const ContactReport& contact = report.steps[step - 1].contact[0];
    Driver fresh(scene_of(lower() + upper(0.9 + 0.25 * (step - 1), "0.1 * (2 * t - 1)") + slides() + steps(2)));
    const ContactReport& expected = solved(fresh).last().contact[0];
    EXPECT_EQ(contact.slip_nodes, contact.nodes);
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(contact.force[i], expected.force[i], 0.002 * expected.force[1]) << i;
    EXPECT_NEAR(contact.area, expected.area, 1e-9);
    EXPECT_NEAR(contact.max_pressure, expected.max_pressure, 0.01 * expected.max_pressure);
    EXPECT_NEAR(contact.force[0], -friction * contact.force[1], 1e-9);
    expect_opposite(contact);
    expect_balance(report.steps[step - 1], 1e-9);
    EXPECT_NEAR(contact.moment[0] + contact.pair->moment[0], 0, 1e-6 * std::abs(contact.moment[0]));
    slid += friction * contact.force[1] * 0.25;
    show("{}: force {:.6g} {:.6g}, as new {:.6g} {:.6g}; moments {:.6g} {:.6g}, {} iterations\n", step,
         contact.force[0], contact.force[1], expected.force[0], expected.force[1], contact.moment[0],
         contact.pair->moment[0], report.steps[step - 1].summary.iterations);
  }
  EXPECT_NEAR(report.last().contact[0].dissipated, slid, 0.05 * slid);
}

// A way back by less than the elastic slip turns nothing round, a longer one all of it.
TEST(Sliding, BackwardsTurnsFrictionRound) {
  Driver driver(scene_of(lower() +
                         upper(1, "t < 0.15 ? 0 : t < 0.75 ? 1.5 * (t - 0.1) / 0.6 : t < 0.85 ? 1.499 : 1.4") +
                         slides() + steps(10)));
  const Report& report = solved(driver);
  const auto part = [&](int step) {
    const ContactReport& contact = report.steps[step - 1].contact[0];
    return contact.force[0] / (friction * contact.force[1]);
  };
  EXPECT_NEAR(part(7), -1, 1e-6);
  EXPECT_GT(part(8), -0.95) << "t = 0.8: back by 0.001";
  EXPECT_LT(part(8), 0.5);
  EXPECT_NEAR(part(10), 1, 1e-6);
}

// Quadratic slaves that the slider covers in part: nodes there share what presses and drags with their neighbours.
TEST(Sliding, QuadraticBodiesKeepCoulombsLaw) {
  const std::string soft = "order = 2\nyoung = 1\npoisson = 0.3\n", hard = "order = 2\nyoung = 4\npoisson = 0.3\n";
  Driver driver(scene_of(block("lower", "[0, -0.7]", "[3, 0]", "[6, 1]", soft) + fix("lower", "bottom", "[0, 0]") +
                         block("upper", "[0.13, 0]", "[1.03, 0.5]", "[3, 2]", hard) +
                         fix("upper", "top", "[\"1.2 * max(0, t - 0.25)\", \"-0.01 * min(1, 4 * t)\"]") + slides() +
                         "[steps]\ncount = 4\n"));
  const Report& report = solved(driver);
  for (std::size_t k = 1; k < report.steps.size(); ++k) {
    const ContactReport& contact = report.steps[k].contact[0];
    EXPECT_EQ(contact.stick_nodes, 0);
    EXPECT_NEAR(contact.normal_force[0], 0, 1e-10);
    EXPECT_NEAR(std::abs(contact.tangential_force[0]), friction * contact.normal_force[1], 1e-9);
  }
}

// Half of the block leaves the lower one at its end.
TEST(Sliding, OverTheEndLosesArea) {
  const auto area = [](const std::string& more) {
    Driver driver(scene_of(lower() + upper(4.5, "1.0 * (5 * t - 1) / 4") + slides(more, "elastic") + steps(5)));
    return solved(driver).last().contact[0].area;
  };
  EXPECT_NEAR(area(""), 0.5, 0.15);
  EXPECT_GT(area("renew = false\n"), 0.7);
}

// A block that is drawn off the end of the lower one stays off, and feels it again once it is drawn back.
TEST(Sliding, OffTheEndThereIsNoForce) {
  Driver driver(scene_of(lower() + upper(4.5, "4 * min(t, 1 - t)") + slides("", "elastic") + steps(20)));
  const Report& report = solved(driver);
  for (std::size_t step = 1; step < report.steps.size(); ++step) {
    const double t = 0.05 * static_cast<double>(step + 1), way = 4 * std::min(t, 1 - t);
    const double force = report.steps[step].contact[0].force[1];
    if (way > 1.51) {
      EXPECT_EQ(force, 0) << t;
    } else if (way < 1.3) {
      EXPECT_GT(force, 1e-4) << t;
    }
  }
}

/// A half disk that is pressed on the block, and then moved along it by two thirds of its diameter.
TEST(Sliding, DiskKeepsItsPressure) {
  Driver driver(scene_of(
      lower() +
      "[[body]]\nname = \"upper\"\nshape = \"half_disk\"\ncenter = [2, 1.6]\nradius = 0.6\nsize = \"0.05 + 0.3 * "
      "sqrt((x - 2)^2 + (y - 1)^2)\"\n" +
      material(2) + fix("upper", "flat", "[\"1.25 * max(0, (6 * t - 1) / 5)\", -0.02]") +
      pair("upper", "curved", "lower", "top", fmt::format("friction = {}\n", friction), "elastic_coulomb") +
      steps(6, 2)));
  const Report& report = solved(driver);
  const ContactReport& first = report.steps[1].contact[0];
  EXPECT_NEAR(first.force[1], report.steps[0].contact[0].force[1], 0.02 * first.force[1]);
  for (std::size_t step = 1; step < report.steps.size(); ++step) {
    SCOPED_TRACE(step);
    const ContactReport& contact = report.steps[step].contact[0];
    show("force {:.6g} {:.6g}, area {:.4g}, pressure {:.4g} (first {:.6g}, {:.4g}, {:.4g}), inside {:.2g}\n",
         contact.force[0], contact.force[1], contact.area, contact.max_pressure, first.force[1], first.area,
         first.max_pressure, contact.largest_penetration);
    EXPECT_EQ(contact.slip_nodes, contact.nodes);
    EXPECT_NEAR(contact.force[1], first.force[1], 0.002 * first.force[1]);
    EXPECT_NEAR(contact.force[0], -friction * contact.force[1], 1e-9);  // along the normal of the flat block
    EXPECT_NEAR(contact.area, first.area, 0.02 * first.area);
    EXPECT_NEAR(contact.max_pressure, first.max_pressure, 0.02 * first.max_pressure);
    expect_opposite(contact);
    expect_balance(report.steps[step], 1e-9);
  }
}

// Linearised about its start a motion in one step leaves the bodies inside each other, which the report does not hide;
// where they are looked at where they have come to nothing is left.
TEST(Sliding, InOneStepIsSeenInTheReport) {
  const auto inside = [](int count, const std::string& renew) {
    Driver driver(scene_of(
        "[[body]]\nname = \"block\"\nshape = \"half_disk\"\ncenter = [0, 0]\nradius = 1\nsize = 0.1\n" + material(1) +
        block("ram", "[-0.2, -2]", "[0.2, -1]", "[4, 10]", material(1)) + fix("block", "flat", "[0, 0]") +
        fix("ram", "bottom", "[\"0.3 * t\", 0.01]") + pair("ram", "top", "block", "curved", renew) + steps(count, 2)));
    const ContactReport& contact = solved(driver).last().contact[0];
    show("{} steps: inside {:.3g}, between nodes {:.3g}, off {:.3g}\n", count, contact.largest_penetration,
         contact.penetration_between_nodes, contact.largest_opening);
    return std::max(contact.largest_penetration, contact.largest_opening);
  };
  const double drawn = inside(1, "renew = false");
  EXPECT_GT(drawn, 4 * inside(8, ""));
  EXPECT_GT(drawn, 20 * inside(1, ""));
}

// Flat faces touch as truly wherever they slide to, but other faces of the other body.
TEST(Sliding, OfFlatBodiesInOneStepIsThatOfBodiesDrawnThere) {
  const auto force = [](const std::string& from, const std::string& to, double way, const std::string& more) {
    Driver driver(
        scene_of(block("base", "[-3, -1]", "[3, 0]", "[24, 4]", "young = \"x < 0 ? 300 : 6000\"\npoisson = 0.3\n") +
                 block("punch", from, to, "[6, 3]", material(3000)) + fix("base", "bottom", "[0, 0]") +
                 fix("punch", "top", fmt::format("[{}, -0.01]", way)) + pair("punch", "bottom", "base", "top", more)));
    return solved(driver).last().contact[0].force[1];
  };
  const double drawn = force("[1, 0]", "[2, 0.5]", 0, "");
  EXPECT_NEAR(force("[-0.5, 0]", "[0.5, 0.5]", 1.5, ""), drawn, 0.01 * drawn);
  EXPECT_NEAR(force("[-0.5, 0]", "[0.5, 0.5]", 1.5, "slave = \"other\"\n"), drawn, 0.02 * drawn);
  EXPECT_NEAR(force("[0.7, 0]", "[1.7, 0.5]", 0.3, ""), drawn, 0.01 * drawn);
}

// In one step that ends beyond the other body forces are those of the pairs as drawn, which the report does not hide.
// Without friction bodies are looked at where they have come to: nothing touches there. With friction steps follow
// them.
TEST(Sliding, PastTheEndInOneStepIsSeenInTheReport) {
  const auto report = [](double way, const std::string& type, const std::string& more) {
    Driver driver(scene_of(block("lower", "[0, 0]", "[2, 1]", "[16, 8]", material(1)) +
                           block("upper", "[1, 1]", "[1.8, 1.6]", "[10, 8]", material(3)) +
                           fix("lower", "bottom", "[0, 0]") + fix("upper", "top", fmt::format("[{}, -0.01]", way)) +
                           pair("upper", "bottom", "lower", "top", more, type)));
    return solved(driver);
  };
  const Report past = report(1.5, "elastic_coulomb", "friction = 0.3"),
               before = report(0.1, "elastic_coulomb", "friction = 0.3");
  EXPECT_EQ(report(1.5, "elastic", "").last().contact[0].nodes, 0);
  ASSERT_GT(past.last().contact[0].nodes, 0);
  EXPECT_EQ(past.last().contact[0].beyond_nodes, past.last().contact[0].nodes);
  const auto told = [](const Report& of) {
    return std::ranges::any_of(of.warnings, [](const std::string& warning) {
      return warning.find("no longer in front of them") != std::string::npos;
    });
  };
  EXPECT_TRUE(told(past));
  EXPECT_FALSE(told(before));
  EXPECT_LE(before.last().contact[0].beyond_nodes, 1);
}

// A slender column that is pushed up beside the lowest point of a round body bends out of the way: each pairing lets it
// slide on to the next one.
TEST(Sliding, StepsThatAreTooLongSaySo) {
  const auto told = [](const std::string& more) {
    Driver driver(
        scene_of("[[body]]\nname = \"round\"\nshape = \"half_disk\"\ncenter = [0, 0]\nradius = 1\nsize = 0.15\n" +
                 material(1) + block("column", "[0.3, -4]", "[0.5, -1]", "[3, 40]", material(0.05)) +
                 fix("round", "flat", "[0, 0]") + fix("column", "bottom", "[0, \"0.6 * t\"]") +
                 pair("column", "top", "round", "curved", more) + "[steps]\nat = [0.1, 1]\n"));
    return std::ranges::any_of(solved(driver).warnings, [](const std::string& warning) {
      return warning.find("after each new pairing they do so again") != std::string::npos;
    });
  };
  EXPECT_TRUE(told(""));
  EXPECT_FALSE(told("renew = false\n"));
}

/// Forces, pressure and nodes in contact at the end.
struct Answer {
  std::vector<double> force;
  double pressure;
  Index nodes;
};

Answer answer(const std::string& scene, const std::string& solver = "") {
  Driver driver(scene_of(scene + "[solver]\ntolerance = 1e-10\n" + solver));
  const ContactReport& contact = solved(driver).last().contact[0];
  return {contact.force, contact.max_pressure, contact.nodes};
}

void expect_same(const Answer& a, const Answer& b) {
  const double size = length(a.force);
  for (std::size_t i = 0; i < a.force.size(); ++i) EXPECT_NEAR(a.force[i], b.force[i], 1e-7 * size) << i;
  EXPECT_NEAR(a.pressure, b.pressure, 1e-6 * a.pressure);
  EXPECT_EQ(a.nodes, b.nodes);
}

// Where bodies are paired anew depends on where they have come to, and not on where unknowns happen to be jumps: these
// are others for other starts and levels.
TEST(Sliding, HasOneAnswerWhateverTheWayToIt) {
  const std::string slider =
      "[[body]]\nname = \"b\"\nshape = \"half_disk\"\ncenter = [0.445, 1]\nradius = 0.98\nsize = 0.142\n" +
      material(0.0558);
  const std::string ground =
      "[[body]]\nname = \"a\"\nshape = \"polygon\"\npoints = [[-1.5, -1], [1.5, -1], [1.5, -0.001], [0.2, 0], [-1.5, "
      "-0.057]]\nsize = 0.201\n" +
      material(19.57, 0.249);
  const std::string rest =
      "[[fix]]\nbody = \"b\"\nwhere = \"y > 0.9\"\nvalue = [\"0.0572 * t\", \"-0.0434 - 0.08 * min(1, 2 * t)\"]\n"
      "[[fix]]\nbody = \"a\"\nwhere = \"y < -0.999\"\nvalue = [0, 0]\n"
      "[[obstacle]]\ntype = \"elastic_coulomb\"\nbody = \"b\"\nwhere = \"y < 0.5\"\nother = \"a\"\n"
      "other_where = \"y > -0.5\"\nfriction = 0.144\n" +
      steps(2, 1);
  const Answer expected = answer(slider + ground + rest);
  for (const char* solver :
       {"start = \"zero\"\n", "hierarchy = \"matrix\"\n", "hierarchy = \"matrix\"\nstart = \"zero\"\n",
        "method = \"newton\"\n", "method = \"monotone\"\n"}) {
    SCOPED_TRACE(solver);
    expect_same(expected, answer(slider + ground + rest, solver));
  }
  SCOPED_TRACE("bodies in another order");
  expect_same(expected, answer(ground + slider + rest));
}

TEST(Sliding, HasOneAnswerWhateverTheWayToItInSpace) {
  const std::string scene =
      "[[body]]\nname = \"b\"\nshape = \"half_ball\"\ncenter = [0.1, 0, 1]\nradius = 1\nsize = 0.5\n" + material(0.1) +
      block("a", "[-1.5, -1, -0.6]", "[1.5, 1, 0]", "[6, 4, 2]", material(2)) +
      fix("b", "flat", "[\"0.3 * t\", \"0.1 * t\", \"-0.2 * min(1, 2 * t)\"]") + fix("a", "bottom", "[0, 0, 0]") +
      pair("b", "curved", "a", "top", "friction = 0.2\n", "elastic_coulomb") + steps(2, 1);
  const Answer expected = answer(scene);
  for (const char* solver : {"start = \"zero\"\n", "hierarchy = \"matrix\"\n"}) {
    SCOPED_TRACE(solver);
    expect_same(expected, answer(scene, solver));
  }
}

}  // namespace
}  // namespace signorini::test
