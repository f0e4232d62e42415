#pragma once
#include <string>
#include <vector>

namespace signorini {

/// A mark of an axis and what is written at it: `text`, and `power` as its exponent.
struct Tick {
  double at;
  std::string text, power;
};

/// The values that an axis shows and its marks among them.
struct Axis {
  double low, high;
  std::vector<Tick> ticks;
};

/// Four to eight marks at multiples of 1, 2 or 5 times a power of ten.
/// @param step the least distance of two marks: 1 for numbers that are counted
Axis linear_axis(double low, double high, double step = 0);
/// The same from the first mark to the last one around [low, high].
Axis widened_axis(double low, double high, double step = 0);
/// Powers of ten, in terms of their logarithms: widened to whole ones.
/// @param low, high logarithms to the base of ten
Axis logarithmic_axis(double low, double high);

}  // namespace signorini
