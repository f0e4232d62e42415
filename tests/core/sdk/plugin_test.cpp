#include "core/sdk/plugin.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "core/component/handshake.hpp"

namespace signorini {
namespace {

using sdk::FingerprintField;
using sdk::guarded;
using testing::StrEq;

TEST(Guarded, ReturnsWhatTheBodyReturns) {
  Status status;
  EXPECT_EQ(guarded(status, [] { return 7; }), 7);
  EXPECT_TRUE(status.ok());
}

TEST(Guarded, AnErrorKeepsItsExitStatus) {
  Status status;
  EXPECT_EQ(guarded(status, []() -> int* { throw Error(Exit::no_solution, "no way"); }), nullptr);
  EXPECT_EQ(status.code, static_cast<int>(Exit::no_solution));
  EXPECT_THAT(status.message, StrEq("no way"));
}

TEST(Guarded, AnyOtherExceptionIsThePluginsFault) {
  Status known, unknown;
  guarded(known, [] { throw std::out_of_range("beyond"); });
  EXPECT_EQ(known.code, static_cast<int>(Exit::plugin));
  EXPECT_THAT(known.message, StrEq("beyond"));
  guarded(unknown, [] { throw 1; });
  EXPECT_EQ(unknown.code, static_cast<int>(Exit::plugin));
}

TEST(Guarded, ALongMessageIsCutOff) {
  Status status;
  guarded(status, [] { throw Error(Exit::input, std::string(5000, 'a')); });
  EXPECT_EQ(std::string(status.message).size(), sizeof status.message - 1);
}

TEST(Fingerprint, EveryFieldHasANameOfItsOwn) {
  std::set<std::string> names;
  for (const FingerprintField& field : sdk::fingerprint) EXPECT_TRUE(names.insert(field.name).second) << field.name;
}

TEST(Fingerprint, AgreesWithItself) { EXPECT_EQ(differences(sdk::fingerprint, sdk::fingerprint), ""); }

TEST(Fingerprint, NamesBothValuesOfEveryDifference) {
  const FingerprintField here[] = {{"a", "x", 0}, {"b", nullptr, 1}, {"c", nullptr, 2}, {"d", nullptr, 3}};
  const FingerprintField plugin[] = {{"c", "2", 0}, {"b", nullptr, 1}, {"a", "y", 0}, {"e", nullptr, 4}};
  EXPECT_EQ(differences(plugin, here),
            "a: 'y' in the plugin, 'x' here; c: '2' in the plugin, 2 here; d: nothing in the plugin, 3 here; "
            "e: 4 in the plugin, nothing here");
}

}  // namespace
}  // namespace signorini
