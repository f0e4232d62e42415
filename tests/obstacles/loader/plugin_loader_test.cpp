// The plugin loader against sound and broken shared libraries.
#include "core/component/plugin_loader.hpp"
#include "core/component/libraries.hpp"

#include <elf.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <utility>

#include "core/base/error.hpp"
#include "core/component/crash.hpp"
#include "core/component/settings.hpp"
#include "core/sdk/plugin.hpp"

namespace signorini {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const fs::path fixtures = SIGNORINI_FIXTURES;

std::string library(const std::string& id) { return "libsignorini_obstacle_" + id + ".so"; }

// An empty folder that is gone with the test.
class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "signorini-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~Folder() { fs::remove_all(path_); }
  const fs::path& path() const { return path_; }
  void add(const std::string& id, const std::string& as) const {
    fs::copy_file(fixtures / library(id), path_ / library(as));
  }

 private:
  fs::path path_;
};

class PluginPath {
 public:
  explicit PluginPath(const std::string& value) { setenv("SIGNORINI_PLUGIN_PATH", value.c_str(), 1); }
  ~PluginPath() { unsetenv("SIGNORINI_PLUGIN_PATH"); }
};

// The message with which a fixture is rejected; "" when it is not.
std::string rejection(const std::string& id, Registry& registry) {
  PluginLoader loader(registry, {fixtures});
  try {
    loader.require(id);
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::plugin);
    return error.what();
  }
  return {};
}

std::string rejection(const std::string& id) {
  Registry registry;
  const std::string message = rejection(id, registry);
  EXPECT_TRUE(registry.entries().empty()) << "registered in spite of: " << message;
  return message;
}

TEST(PluginLoader, RegistersWhatAPluginProvidesWithItsFileAndVersion) {
  Registry registry;
  EXPECT_EQ(rejection("good", registry), "");
  const Entry& entry = registry.entry("obstacle", "good");
  EXPECT_EQ(entry.file, (fixtures / library("good")).string());
  EXPECT_EQ(entry.version, "1.2.3");
  EXPECT_EQ(entry.help, "for tests");
  EXPECT_EQ(registry.entries().size(), 1u) << "a library is loaded only when its obstacle is asked for";
}

TEST(PluginLoader, RequiringTwiceLoadsOnce) {
  Registry registry;
  EXPECT_EQ(rejection("good", registry), "");
  EXPECT_EQ(rejection("good", registry), "");
  EXPECT_EQ(registry.entries().size(), 1u);
}

TEST(PluginLoader, NamesTheFileOfWhateverItRejects) {
  for (const std::string id : {"wrong_magic", "wrong_field", "no_symbol", "failing_registration", "not_elf"})
    EXPECT_THAT(rejection(id), HasSubstr((fixtures / library(id)).string()));
}

TEST(PluginLoader, RejectsAWrongMagicWord) { EXPECT_THAT(rejection("wrong_magic"), HasSubstr("magic")); }

TEST(PluginLoader, RejectsAShortEntry) { EXPECT_THAT(rejection("short_struct"), HasSubstr("24 bytes")); }

TEST(PluginLoader, RejectsNullMembers) { EXPECT_THAT(rejection("null_member"), HasSubstr("null members")); }

TEST(PluginLoader, RejectsAnotherMajorVersionNamingBoth) {
  EXPECT_THAT(rejection("wrong_major"), AllOf(HasSubstr("plugin interface: 0.0 in the plugin, 6.0 here"),
                                              HasSubstr("rebuild against SDK 6.0"), Not(HasSubstr("newer"))));
}

TEST(PluginLoader, ANewerMinorVersionNeedsANewerProgram) {
  EXPECT_THAT(rejection("newer_minor"),
              AllOf(HasSubstr("6.1 in the plugin, 6.0 here"), HasSubstr("needs a newer signorini with SDK 6.1")));
}

TEST(PluginLoader, TakesPluginsOfAnOlderMinorVersionWhoseEntryIsShorter) {
  Registry registry;
  EXPECT_EQ(rejection("older_minor", registry), "");
  EXPECT_EQ(licence_of((fixtures / library("older_minor")).string()), "");
}

TEST(PluginLoader, KnowsTheLicencesOfAllThatIsLoaded) {
  Registry registry;
  EXPECT_EQ(rejection("licensed", registry), "");
  EXPECT_EQ(rejection("good", registry), "");
  EXPECT_EQ(licence_of((fixtures / library("licensed")).string()), "MIT");
  EXPECT_EQ(licence_of((fixtures / library("good")).string()), "") << "it does not say";
  const std::vector<Library> all = loaded_libraries();
  EXPECT_THAT(all.front().file, HasSubstr("libsignorini_core.so"));
  EXPECT_EQ(all.front().licence, "BSD-3-Clause");
  for (const char* id : {"licensed", "good"})
    EXPECT_EQ(std::ranges::count(all, (fixtures / library(id)).string(), &Library::file), 1) << id;
}

TEST(PluginLoader, NamesTheFieldInWhichTheBuildsDiffer) {
  EXPECT_THAT(rejection("wrong_field"),
              AllOf(HasSubstr("EIGEN_MAX_ALIGN_BYTES: 17 in the plugin, 32 here: rebuild against SDK 6.0"),
                    Not(HasSubstr(";"))));
}

TEST(PluginLoader, NamesAllDifferencesInOneMessage) {
  EXPECT_THAT(rejection("wrong_fields"),
              AllOf(HasSubstr("7.0 in the plugin, 6.0 here"), HasSubstr("compiler: 'tcc' in the plugin, '"),
                    HasSubstr("size of Index: 8 in the plugin, 4 here"), HasSubstr(": nothing in the plugin, "),
                    HasSubstr("rebuild against SDK 6.0")));
}

TEST(PluginLoader, RejectsALibraryThatIsNoPlugin) {
  EXPECT_THAT(rejection("no_symbol"), HasSubstr("no symbol 'signorini_plugin'"));
}

TEST(PluginLoader, RejectsAFileThatIsNoLibrary) { EXPECT_THAT(rejection("not_elf"), HasSubstr("file too short")); }

TEST(PluginLoader, LibrariesThatEndAProgramWhileBeingLoadedAreRejectedAndTheOthersListed) {
  Registry registry;
  PluginLoader loader(registry, {fixtures / "fatal", fixtures});
  const auto rejected = loader.load_all();
  const auto reason = [&](const std::string& id) -> std::string {
    for (const auto& found : rejected)
      if (found.file == fixtures / "fatal" / library(id)) return found.reason;
    return "not rejected";
  };
  EXPECT_THAT(reason("throwing_library"), HasSubstr("an exception that nothing catches"));
  EXPECT_THAT(reason("crashing_library"), HasSubstr("a crash (Segmentation fault)"));
  EXPECT_THAT(reason("exiting_library"), HasSubstr("ended with status 0"));
  EXPECT_TRUE(registry.has("obstacle", "good"));
}

// Overwrites an entry of the table that the loader of the system reads; returns whether there is one.
bool damage(const fs::path& file, Elf64_Sxword tag, Elf64_Xword value) {
  std::fstream io(file, std::ios::in | std::ios::out | std::ios::binary);
  const auto read = [&](auto& item, std::uint64_t at) {
    io.seekg(static_cast<std::streamoff>(at));
    io.read(reinterpret_cast<char*>(&item), sizeof item);
  };
  Elf64_Ehdr head{};
  read(head, 0);
  for (unsigned k = 0; k < head.e_phnum; ++k) {
    Elf64_Phdr segment{};
    read(segment, head.e_phoff + k * sizeof segment);
    if (segment.p_type != PT_DYNAMIC) continue;
    for (std::uint64_t at = segment.p_offset; at < segment.p_offset + segment.p_filesz; at += sizeof(Elf64_Dyn)) {
      Elf64_Dyn entry{};
      read(entry, at);
      if (entry.d_tag != tag) continue;
      entry.d_un.d_val = value;
      io.seekp(static_cast<std::streamoff>(at));
      io.write(reinterpret_cast<const char*>(&entry), sizeof entry);
      return io.good();
    }
  }
  return false;
}

// The loader of the system crashes of the first and ends the program with status 127 for the second.
TEST(PluginLoader, RejectsADamagedLibrary) {
  for (const auto& [tag, value] : {std::pair{DT_SYMTAB, 1ull << 40}, std::pair{DT_RELACOUNT, 1ull << 40}}) {
    const Folder folder;
    folder.add("good", "good");
    ASSERT_TRUE(damage(folder.path() / library("good"), tag, value));
    Registry registry;
    PluginLoader loader(registry, {folder.path()});
    const auto rejected = loader.load_all();
    ASSERT_EQ(rejected.size(), 1u) << tag;
    EXPECT_THAT(rejected.front().reason, HasSubstr("the file is damaged")) << tag;
  }
}

/// Assembles the obstacle of the fixture in that way.
void misbehave(const char* way) {
  name_plugins_that_crash();
  Registry registry;
  PluginLoader loader(registry, {fixtures});
  loader.require("misbehaving");
  const ObstacleType& type = registry.obstacle("misbehaving");
  const auto settings = compile_settings("obstacle 'misbehaving'", {type.options, type.option_count},
                                         {"scene", {{"way", {std::string(way), "way"}}}});
  Status status;
  const std::unique_ptr<Obstacle<1>> obstacle(type.create1(*settings, status));
  LocalConstraint<1> constraint;
  const SurfaceVertex vertex{};
  obstacle->assemble(&vertex, 1, &constraint, status);
  check_asked(*settings);
}

TEST(PluginLoaderDeathTest, AVirtualFunctionThatThrowsOrCrashesEndsTheProgramNamingThePlugin) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const auto failed = testing::ExitedWithCode(static_cast<int>(Exit::plugin));
  EXPECT_EXIT(misbehave("throw"), failed, "misbehaving.so: an exception left a function of the plugin");
  EXPECT_EXIT(misbehave("segv"), failed, "misbehaving.so: the plugin reached outside its memory");
  EXPECT_EXIT(misbehave("divide"), failed, "misbehaving.so: the plugin made a forbidden operation");
  EXPECT_EXIT(misbehave("abort"), failed, "misbehaving.so: the plugin gave up");
  EXPECT_EXIT(misbehave("trap"), failed, "misbehaving.so: the plugin met an illegal instruction");
  EXPECT_EXIT(misbehave("exit"), failed, "misbehaving.so: the plugin ended the program");
  EXPECT_EXIT(misbehave("quick_exit"), failed, "misbehaving.so: the plugin ended the program");
  EXPECT_EXIT((name_plugins_that_crash(), std::exit(0)), testing::ExitedWithCode(0), "");
  EXPECT_EXIT((name_plugins_that_crash(), std::abort()), testing::KilledBySignal(SIGABRT), "");
  misbehave("behave");
}

TEST(PluginLoader, AnOptionThatIsNotInTheTableIsNamed) {
  try {
    misbehave("misspell");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::plugin);
    EXPECT_THAT(error.what(), AllOf(HasSubstr("'misbehaving'"), HasSubstr("'wey'"), HasSubstr("did you mean 'way'?")));
  }
}

TEST(PluginLoader, RejectsRangesAndDefaultsThatCannotBeMet) {
  EXPECT_THAT(rejection("bad_range"), AllOf(HasSubstr("the range '(oops' of option 'gap'"), HasSubstr("interval")));
  EXPECT_THAT(rejection("bad_default"), AllOf(HasSubstr("default of 'gap'"), HasSubstr("[0, 1]")));
}

TEST(PluginLoader, RejectsAPluginCompiledWithFastMath) {
  EXPECT_THAT(rejection("fast_math"), AllOf(HasSubstr("fast math: 1 in the plugin, 0 here"), HasSubstr("finite math")));
}

TEST(PluginLoader, TellsPluginsCompiledWithoutOptimisation) {
  Registry registry;
  EXPECT_EQ(rejection("unoptimised", registry), "");
  EXPECT_FALSE(registry.entry("obstacle", "unoptimised").optimised);
#if defined(__OPTIMIZE__)
  EXPECT_EQ(rejection("good", registry), "");
  EXPECT_TRUE(registry.entry("obstacle", "good").optimised);
#endif
}

TEST(PluginLoader, RejectsATruncatedLibrary) {
  const auto size = fs::file_size(fixtures / library("good"));
  for (const double part : {0.02, 0.3, 0.6, 0.9, 0.999}) {
    const Folder folder;
    folder.add("good", "good");
    fs::resize_file(folder.path() / library("good"), static_cast<std::uintmax_t>(part * static_cast<double>(size)));
    Registry registry;
    PluginLoader loader(registry, {folder.path()});
    const auto rejected = loader.load_all();
    ASSERT_THAT(rejected, testing::Not(testing::IsEmpty())) << part;
    EXPECT_THAT(rejected.front().reason, HasSubstr("truncated")) << part;
  }
}

TEST(PluginLoader, AConstructorThatThrowsIsAStatusNotAnException) {
  Registry registry;
  EXPECT_EQ(rejection("throwing_constructor", registry), "");
  const auto settings = compile_settings("obstacle", {}, {});
  Status status;
  EXPECT_EQ(registry.obstacle("throwing_constructor").create1(*settings, status), nullptr);
  EXPECT_EQ(status.code, static_cast<int>(Exit::plugin));
  EXPECT_STREQ(status.message, "thrown by the constructor");
}

TEST(PluginLoader, CommitsNothingWhenRegistrationThrows) {
  EXPECT_THAT(rejection("throwing_registration"), HasSubstr("an exception of unknown type"));
}

TEST(PluginLoader, CommitsNothingWhenRegistrationFails) {
  EXPECT_THAT(rejection("failing_registration"), HasSubstr("its licence has expired"));
}

TEST(PluginLoader, CommitsNothingWhenAFailureGoesUnseenByThePlugin) {
  EXPECT_THAT(rejection("careless_registration"), HasSubstr("'No Identifier' is no obstacle id"));
}

TEST(PluginLoader, ADuplicateNamesBothProvidersAndCommitsNothing) {
  Registry registry;
  EXPECT_EQ(rejection("good", registry), "");
  EXPECT_THAT(rejection("duplicate", registry),
              AllOf(HasSubstr("obstacle 'good' is provided twice"), HasSubstr((fixtures / library("good")).string()),
                    HasSubstr((fixtures / library("duplicate")).string())));
  EXPECT_FALSE(registry.has("obstacle", "duplicate"));
}

TEST(PluginLoader, RejectsALibraryNamedAfterAnotherObstacle) {
  Registry registry;
  EXPECT_THAT(rejection("misnamed", registry), HasSubstr("provides no obstacle 'misnamed'"));
}

TEST(PluginLoader, AMissingPluginSaysWhereItLookedAndWhatIsNear) {
  EXPECT_THAT(rejection("goodd"), AllOf(HasSubstr("did you mean 'good'?"), HasSubstr(fixtures.string()),
                                        HasSubstr("signorini/plugins"), HasSubstr(library("goodd"))));
}

TEST(PluginLoader, AnIdCannotLeaveTheFolder) {
  const Folder folder;
  fs::create_directory(folder.path() / "libsignorini_obstacle_");
  fs::copy_file(fixtures / library("good"), folder.path() / "libsignorini_obstacle_" / "good.so");
  Registry registry;
  PluginLoader loader(registry, {folder.path()});
  EXPECT_THROW(loader.require("/good"), Error);
}

TEST(PluginLoader, NeitherTheCurrentFolderNorFoldersBelowAreSearched) {
  const Folder folder;
  folder.add("good", "good");
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  Registry registry;
  const PluginPath nothing("::");
  EXPECT_THROW(PluginLoader(registry).require("good"), Error);
  EXPECT_THROW(PluginLoader(registry, {folder.path().parent_path()}).require("good"), Error);
  fs::current_path(before);
}

TEST(PluginLoader, ARelativePathInTheEnvironmentIsAnError) {
  const PluginPath relative("plugins");
  Registry registry;
  EXPECT_THROW(PluginLoader{registry}, Error);
}

TEST(PluginLoader, WhatEverybodyMayWriteIsNotLoaded) {
  for (const auto& [of_folder, of_file] : {std::pair{0777, 0644}, {01777, 0644}, {0755, 0666}}) {
    const Folder folder;
    folder.add("good", "good");
    fs::permissions(folder.path() / library("good"), static_cast<fs::perms>(of_file));
    fs::permissions(folder.path(), static_cast<fs::perms>(of_folder));
    Registry registry;
    PluginLoader loader(registry, {folder.path()});
    const auto rejected = loader.load_all();
    ASSERT_EQ(rejected.size(), 1u);
    EXPECT_THAT(rejected[0].reason, AllOf(testing::StartsWith("everybody may"), HasSubstr("chmod o-w")));
    EXPECT_THROW(loader.require("good"), Error);
    EXPECT_FALSE(registry.has("obstacle", "good"));
  }
}

TEST(PluginLoader, TheScenesFoldersComeBeforeTheEnvironment) {
  const Folder scene, environment;
  scene.add("good", "good");
  environment.add("good", "good");
  const PluginPath path("/nowhere:" + environment.path().string());
  Registry registry;
  PluginLoader(registry, {scene.path()}).require("good");
  EXPECT_EQ(registry.entry("obstacle", "good").file, scene.path() / library("good"));
  Registry other;
  PluginLoader(other).require("good");
  EXPECT_EQ(other.entry("obstacle", "good").file, environment.path() / library("good"));
}

TEST(PluginLoader, TheOwnPluginsAreFoundBesideTheCoreLibrary) {
  Registry registry;
  PluginLoader(registry).require("contact");
  EXPECT_EQ(fs::path(registry.entry("obstacle", "contact").file).parent_path(),
            fs::path(SIGNORINI_BINARY_DIR) / "lib/signorini/plugins");
}

TEST(Catalogue, ListsAllPluginsAndTheRejectedOnesWithTheReason) {
  Registry registry;
  PluginLoader loader(registry, {fixtures});
  const Catalogue all = catalogue(registry, loader, "obstacle");
  std::vector<std::string> ids, rejected;
  for (const Entry& entry : all.entries) ids.push_back(entry.id);
  for (const auto& [file, reason] : all.rejected) {
    rejected.push_back(fs::path(file).filename());
    EXPECT_FALSE(reason.empty()) << file;
    EXPECT_THAT(reason, Not(testing::StartsWith(file)));
  }
  EXPECT_THAT(ids, testing::IsSupersetOf({"good", "scalar", "contact", "throwing_constructor", "renamed"}));
  EXPECT_THAT(rejected, testing::IsSupersetOf({library("wrong_magic"), library("not_elf"), library("no_symbol")}));
  EXPECT_EQ(catalogue(registry, loader, "smoother").entries.size(), 0u);
}

TEST(Catalogue, ALibraryHiddenByAnEarlierFolderIsNeitherLoadedNorRejected) {
  const Folder first, second;
  first.add("good", "good");
  second.add("good", "good");
  Registry registry;
  PluginLoader loader(registry, {first.path(), second.path()});
  EXPECT_TRUE(loader.load_all().empty());
  EXPECT_EQ(registry.entry("obstacle", "good").file, first.path() / library("good"));
}

TEST(Catalogue, WhatIsLoadedAlreadyIsNotLoadedAgain) {
  const Folder folder;
  folder.add("misnamed", "misnamed");
  Registry registry;
  PluginLoader loader(registry, {folder.path()});
  EXPECT_TRUE(loader.load_all().empty());
  EXPECT_TRUE(loader.load_all().empty());
}

TEST(Catalogue, ShowsOptionsAsThePluginDeclaresThem) {
  Registry registry;
  PluginLoader(registry).require("contact");
  const Entry& contact = registry.entry("obstacle", "contact");
  ASSERT_EQ(contact.options.size(), 1u);
  EXPECT_STREQ(contact.options[0].name, "normal");
  EXPECT_STREQ(contact.options[0].fallback, "obstacle");
  EXPECT_STREQ(contact.options[0].range, "obstacle | body");
}

}  // namespace
}  // namespace signorini
