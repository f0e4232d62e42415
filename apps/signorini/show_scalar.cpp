#include <algorithm>

#include "apps/signorini/drawn_level.hpp"
#include "apps/signorini/show.hpp"
#include "apps/signorini/slice.hpp"

namespace signorini {
namespace {
std::vector<double> contact_indicator(const std::vector<Flags>& contact) {
  std::vector<double> result(contact.size());
  std::transform(contact.begin(), contact.end(), result.begin(), [](Flags flags) { return flags ? 1.0 : 0.0; });
  return result;
}

Panel scalar_panel(const Shown<2>& shown, const std::vector<double>& value, View view, Warnings& notes) {
  Panel panel;
  panel.view = view;
  panel.patches = few_patches(shown, notes, true, [&](const Drawn<2>& drawn) {
    std::vector<Patch> patches;
    for (const auto& element : drawn.mesh->elements) {
      if (is_too_many(patches)) break;
      Patch& patch = patches.emplace_back();
      for (int c = 0; c < 3; ++c) {
        set_corner(patch, c, drawn.mesh->points[element[c]], value[drawn.fine[element[c]]]);
        if (view == View::graph) patch.corner[c][2] = patch.value[c];
      }
    }
    return patches;
  });
  return panel;
}

/// A section through the middle; not exactly there, where vertices of regular meshes lie.
Panel scalar_panel(const Shown<3>& shown, const std::vector<double>& value, View, Warnings& notes) {
  const auto& points = shown.hierarchy.finest().points;
  const auto [low, high] =
      std::minmax_element(points.begin(), points.end(), [](const auto& a, const auto& b) { return a[1] < b[1]; });
  const double at = 0.4999 * (*low)[1] + 0.5001 * (*high)[1];
  Panel panel;
  panel.patches = few_patches(shown, notes, false, [&](const Drawn<3>& drawn) {
    std::vector<double> values;
    for (const Index v : drawn.fine) values.push_back(value[v]);
    return slice(drawn.mesh->elements, drawn.mesh->points, values, {{0, at, 0}, {1, 0, 0}, {0, 0, 1}});
  });
  return panel;
}

}  // namespace

template <int D>
std::vector<Panel> scalar_panels(const Shown<D>& shown, Warnings& notes) {
  std::vector<Panel> panels{scalar_panel(shown, shown.value, View::graph, notes)};
  panels[0].title = panels[0].label = shown.label;
  if (std::none_of(shown.contact.begin(), shown.contact.end(), [](Flags flags) { return flags != 0; })) return panels;
  panels.push_back(scalar_panel(shown, contact_indicator(shown.contact), View::flat, notes));
  panels[1].title = "coincidence set";
  panels[1].label = "1 in contact";
  return panels;
}

template std::vector<Panel> scalar_panels(const Shown<2>&, Warnings&);
template std::vector<Panel> scalar_panels(const Shown<3>&, Warnings&);

}  // namespace signorini
