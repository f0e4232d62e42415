#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "apps/scenes/tables.hpp"
#include "core/base/error.hpp"
#include "driver/driver.hpp"

/// Scenes of bodies in contact with each other.
namespace signorini::test {

inline std::string pair(const std::string& body, const std::string& on, const std::string& other,
                        const std::string& other_on, const std::string& more = "",
                        const std::string& type = "elastic") {
  return fmt::format("[[obstacle]]\ntype = \"{}\"\nbody = \"{}\"\non = \"{}\"\nother = \"{}\"\nother_on = \"{}\"\n{}\n",
                     type, body, on, other, other_on, more);
}

inline std::string material(double young, double poisson = 0.3, int order = 1) {
  return fmt::format("order = {}\nyoung = {}\npoisson = {}\n", order, young, poisson);
}

inline Scene scene_of(const std::string& text) { return parse_scene(text, "test.toml", "."); }

inline double length(const std::vector<double>& v) {
  double square = 0;
  for (const double c : v) square += c * c;
  return std::sqrt(square);
}

/// Forces on both bodies are equal and opposite.
inline void expect_opposite(const ContactReport& contact, double tolerance = 1e-12) {
  ASSERT_TRUE(contact.pair);
  ASSERT_EQ(contact.force.size(), contact.pair->force.size());
  for (std::size_t i = 0; i < contact.force.size(); ++i)
    EXPECT_NEAR(contact.force[i] + contact.pair->force[i], 0, tolerance * length(contact.force));
}

/// All bodies are in balance.
inline void expect_balance(const StepReport& step, double tolerance) {
  for (const BalanceReport& balance : step.balance)
    for (const double left : balance.sum()) EXPECT_NEAR(left, 0, tolerance) << balance.body;
}

inline void expect_error(const std::string& text, Exit status, const std::string& part) {
  try {
    Driver(scene_of(text)).solve();
    ADD_FAILURE() << "no error: " << part;
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), status);
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
  }
}

/// Prints a line when the environment asks to SHOW what the tests measure.
template <class... Values>
void show(fmt::format_string<Values...> format, Values&&... values) {
  if (std::getenv("SHOW")) fmt::print(format, std::forward<Values>(values)...);
}

}  // namespace signorini::test
