#include "core/io/picture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <limits>
#include <random>
#include <sstream>

#include "core/base/error.hpp"
#include "core/io/cairo/axis.hpp"
#include "core/io/cairo/png.hpp"
#include "core/io/raster.hpp"
#include "core/io/read_file.hpp"
#include "core/io/vtu_bytes.hpp"
#include "tests/support/folder.hpp"

namespace signorini {
namespace {

std::uint32_t number(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k) value = value << 8 | static_cast<unsigned char>(bytes.at(at + k));
  return value;
}

/// A PNG file read as its specification says; files of other kinds than ours are not expected.
struct Decoded {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint32_t> pixels;

  explicit Decoded(const std::string& file) { read(file); }

  std::size_t count(std::uint32_t colour) const { return std::count(pixels.begin(), pixels.end(), colour); }

 private:
  void read(const std::string& file) {
    EXPECT_EQ(file.substr(0, 8), "\x89PNG\r\n\x1a\n");
    std::string data, last;
    for (std::size_t at = 8; at < file.size();) {
      const std::uint32_t size = number(file, at);
      last = file.substr(at + 4, 4);
      const std::string body = file.substr(at + 8, size);
      EXPECT_EQ(crc32(0, reinterpret_cast<const Bytef*>(&file[at + 4]), size + 4), number(file, at + 8 + size)) << last;
      if (last == "IHDR") {
        width = number(body, 0), height = number(body, 4);
        EXPECT_EQ(body.substr(8), std::string({8, 2, 0, 0, 0}));
      }
      if (last == "IDAT") data += body;
      at += 12 + size;
    }
    EXPECT_EQ(last, "IEND");
    const auto rows = inflate(data, height * (1 + 3 * std::size_t{width}));
    ASSERT_TRUE(rows) << "damaged data";
    for (std::size_t row = 0, at = 0; row < height; ++row) {
      const char filter = rows->at(at++);
      ASSERT_TRUE(filter == 0 || filter == 2);
      for (std::size_t column = 0; column < width; ++column) {
        std::uint32_t pixel = 0;
        for (int shift = 16; shift >= 0; shift -= 8) {
          const std::uint32_t above = filter == 2 && row > 0 ? pixels[pixels.size() - width] >> shift & 0xff : 0;
          pixel |= ((static_cast<unsigned char>(rows->at(at++)) + above) & 0xff) << shift;
        }
        pixels.push_back(pixel);
      }
    }
  }
};

TEST(Png, PixelsComeBack) {
  std::mt19937 random(1);
  for (const auto& [width, height] : {std::pair{1, 1}, std::pair{7, 3}, std::pair{300, 200}}) {
    std::vector<std::uint32_t> pixels(std::size_t(width) * height);
    for (auto& pixel : pixels) pixel = random() & 0xffffff;
    const Decoded decoded(png(pixels, width, height));
    EXPECT_EQ(decoded.width, width);
    EXPECT_EQ(decoded.height, height);
    EXPECT_EQ(decoded.pixels, pixels);
  }
}

TEST(Axis, MarksAreFewRoundAndWithin) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(-1, 1), power(-12, 12);
  for (int k = 0; k < 1000; ++k) {
    const double a = number(random) * std::pow(10, power(random)), b = number(random) * std::pow(10, power(random));
    const double low = std::min(a, b), high = std::max(a, b), room = 1e-5 * (high - low);
    const Axis axis = linear_axis(low, high), wide = widened_axis(low, high);
    EXPECT_THAT(axis.ticks.size(), testing::AllOf(testing::Ge(2u), testing::Le(9u))) << low << " " << high;
    EXPECT_GE(axis.ticks.front().at, low - room);
    EXPECT_LE(axis.ticks.back().at, high + room);
    EXPECT_LE(wide.low, low + room);
    EXPECT_GE(wide.high, high - room);
    EXPECT_EQ(wide.ticks.front().at, wide.low + 0.0);
    for (const Tick& tick : axis.ticks) EXPECT_NE(tick.text, "-0");
  }
}

TEST(Axis, OneValueAndCountsHaveMarks) {
  EXPECT_GE(linear_axis(0.3, 0.3).ticks.size(), 2u);
  EXPECT_GE(linear_axis(4.999999999999997, 5.000000000000002).ticks.size(), 2u);  // one value and rounding
  EXPECT_GE(widened_axis(-5.000000000000002, -4.999999999999997).ticks.size(), 2u);
  EXPECT_GE(widened_axis(0, 0).ticks.size(), 2u);
  std::vector<std::string> marks;
  for (const Tick& tick : linear_axis(0.5, 3.5, 1).ticks) marks.push_back(tick.text);
  EXPECT_THAT(marks, testing::ElementsAre("1", "2", "3"));
  marks.clear();
  for (const Tick& tick : logarithmic_axis(-3.5, -1.2).ticks) marks.push_back(tick.text + "^" + tick.power);
  EXPECT_THAT(marks, testing::ElementsAre("10^-4", "10^-3", "10^-2", "10^-1"));
}

class Picture : public test::Folder {
 protected:
  Decoded drawn() const { return Decoded(read_file(folder_ / "a.png", "picture")); }
};

TEST_F(Picture, ShowsTheCurvesOfTheHistory) {
  constexpr double infinite = std::numeric_limits<double>::infinity(), unknown = std::nan("");
  constexpr std::uint32_t blue = 0x2166ac, red = 0xb2182b;
  painter().convergence(folder_ / "a.png", {});
  const Decoded empty = drawn();
  EXPECT_GT(empty.count(0xffffff), empty.pixels.size() / 2);
  painter().convergence(folder_ / "a.png", {{1, 3e-3, 3e-2, 0, 3, 0, {}, 0}, {2, 3e-3, 3e-2, 0, 4, 0, {}, 0}});
  const Decoded both = drawn();
  EXPECT_GT(both.count(blue), empty.count(blue) + 300);
  EXPECT_GT(both.count(red), empty.count(red) + 300);
  painter().convergence(folder_ / "a.png", {{1, 0, 1, 0, 3, 0, {}, 0}, {2, infinite, unknown, 0, 4, 0, {}, 0}});
  EXPECT_EQ(drawn().count(blue), empty.count(blue)) << "neither zero nor infinity is on a logarithmic axis";
}

TEST_F(Picture, HoldsTheRastersOfItsPanels) {
  Panel panel;
  panel.patches = {{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {2, 2, 2}}, {{{0, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {2, 2, 2}}};
  Panel curve;
  curve.view = View::lines;
  curve.lines.push_back({{{0, 1}, {1, 2}}});
  painter().panels(folder_ / "a.png", {panel});
  const Decoded one = drawn();
  painter().panels(folder_ / "a.png", {panel, curve});
  const Decoded two = drawn();
  EXPECT_EQ(two.width, 2 * one.width);
  EXPECT_EQ(two.height, one.height);
  const auto [r, g, b] = colour(0.5);  // of the only value there is
  const std::uint32_t middle = r << 16 | g << 8 | b;
  EXPECT_GT(one.count(middle), 400u * 400u);
  EXPECT_EQ(one.count(middle), two.count(middle));
}

TEST_F(Picture, ShowsWhatValuesMean) {
  Panel panel;
  panel.words = {"open", "slip", "stick"};
  panel.patches = {{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {2, 2, 2}}};
  painter().panels(folder_ / "a.png", {panel});
  const Decoded picture = drawn();
  const auto count = [&](double part) {
    const auto [r, g, b] = colour(part);
    return picture.count(static_cast<std::uint32_t>(r << 16 | g << 8 | b));
  };
  EXPECT_GT(count(1), 300u * 300u / 2) << "the patch";
  for (const double part : {0.0, 0.5}) EXPECT_GT(count(part), 2000u) << "a third of the legend";
}

TEST_F(Picture, LinesMayBeMarksAloneAndHaveGaps) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  constexpr std::uint32_t red = 0xb2182b, blue = 0x2166ac;
  const auto picture = [&](std::vector<Line> lines) {
    Panel panel;
    panel.view = View::lines;
    panel.lines = std::move(lines);
    painter().panels(folder_ / "a.png", {panel});
    return drawn();
  };
  const std::vector<std::array<double, 2>> steep{{0, 0}, {1, 1}, {2, 3}}, gap{{0, 0}, {1, nothing}, {2, 3}};
  const Decoded joined = picture({{steep}}), marks = picture({{steep, "", false}}), apart = picture({{gap}});
  EXPECT_GT(joined.count(red), marks.count(red) + 300);
  EXPECT_GT(marks.count(red), apart.count(red)) << "three marks and two";
  EXPECT_GT(apart.count(red), 0u);
  EXPECT_GT(picture({{steep}, {gap, "second"}}).count(blue), 50u) << "its marks and its key";
  EXPECT_EQ(picture({{{{0, nothing}}}}).count(red), 0u) << "nothing to draw";
}

TEST_F(Picture, LogarithmicAxesMakePowersStraightLines) {
  constexpr std::uint32_t red = 0xb2182b;
  const auto picture = [&](std::vector<std::array<double, 2>> points, bool logarithmic) {
    Panel panel;
    panel.view = View::lines;
    panel.logarithmic = logarithmic;
    panel.lines = {{std::move(points)}};
    painter().panels(folder_ / "a.png", {panel});
    std::vector<bool> drawn_red;
    for (const std::uint32_t pixel : drawn().pixels) drawn_red.push_back(pixel == red);
    return drawn_red;
  };
  const auto straight = picture({{0, 0}, {1, 2}, {3, 6}}, false);
  EXPECT_GT(std::ranges::count(straight, true), 300);
  EXPECT_EQ(picture({{1, 1}, {10, 100}, {1e3, 1e6}}, true), straight);
  EXPECT_EQ(picture({{1, 1}, {10, 100}, {1e3, 1e6}, {0, 10}, {20, -1}}, true), straight) << "they have no logarithm";
}

TEST_F(Picture, ThatCannotBeWrittenIsNamed) {
  EXPECT_THROW(painter().convergence(folder_ / "none" / "a.png", {}), Error);
  try {
    load_painter("/none/libsignorini_pictures.so");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Exit::plugin);
    EXPECT_THAT(error.what(), testing::HasSubstr("/none/libsignorini_pictures.so"));
  }
}

}  // namespace
}  // namespace signorini
