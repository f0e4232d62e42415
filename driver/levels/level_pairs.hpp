#pragma once
#include <span>
#include <utility>
#include <vector>

#include "core/solver/prolongation.hpp"
#include "driver/levels/mesh_levels.hpp"

namespace signorini {

/// Where bodies find each other and rigid obstacles, from one load step to the next. And where, on each mesh, unknowns
/// are jumps between bodies that may touch each other: where a solution says that they nearly do, and all over the
/// slaves where prescribed values do not hold all bodies.
template <int D, int B>
class LevelPairs {
 public:
  using Pairs = typename MeshLevel<D, B>::Pairs;

  /// Keeps a reference.
  explicit LevelPairs(MeshLevels<D, B>& levels) : levels_(levels) {}

  /// From now on this is the coarsest mesh that is a level. Interpolation between meshes knows no jumps.
  void begin_at(std::size_t first);

  /// Of a new model all that may touch; to be called where changes_unknowns(). In the first load step as the undeformed
  /// bodies lie to each other. Where nothing but gaps is new unknowns stay what they are.
  /// @return whether they stay
  bool find(const Model<B>& model);

  /// Where a displacement of the finest mesh has taken bodies past each other, in the mean of where they nearly touch,
  /// by a part of an element since they last found each other, the shift() about which find() is to find them from now
  /// on. The conditions of rigid obstacles are linear about the displacement there, see moved_on(). That depends on the
  /// displacement and on where they found each other, not on where unknowns are jumps: these are others for every start
  /// and hierarchy. Elsewhere the shift() that there is.
  std::vector<Point<B>> shift_after(const Model<B>& model, const std::vector<double>& u) const {
    return shift_after({shift_, levels_.finest().all_pairs}, model, u);
  }
  bool would_follow(const Model<B>& model, const std::vector<double>& u) const {
    return shift_after(model, u) != shift_;
  }
  void find_about(std::vector<Point<B>> shift) { shift_ = std::move(shift); }

  /// The model whose rigid obstacles are where bodies have found them.
  Model<B> moved(const Model<B>& model) const { return moved(model, shift_); }
  /// Steps after this one begin from where bodies have found each other now.
  void accept() { accepted_ = {shift_, levels_.finest().all_pairs}; }
  /// A step that follows another one begins, or begins again, with that one's displacement: follows it from there. In
  /// another one bodies lie as they are drawn.
  void begin_step(const Model<B>& model, const std::vector<double>& u) {
    shift_ = model.follows ? shift_after(accepted_, model, u) : std::vector<Point<B>>();
  }

  /// What a solve has found.
  struct Found {
    std::vector<std::pair<Pairs, Pairs>> of_level;  // all and chosen
    std::vector<Point<B>> shift;
  };
  Found found() const;
  void put_back(Found found);
  /// The next solve finds pairs about shift() as if there had been none, but for those that are given.
  void forget();

  /// From now on these are all that may touch, per mesh, whatever the model says.
  void give(std::vector<Pairs> pairs);
  bool given() const { return given_; }

  /// Per obstacle by how much slaves were taken to have moved past masters when they found each other, and bodies past
  /// rigid obstacles; empty: not.
  const std::vector<Point<B>>& shift() const { return shift_; }

  /// What unknowns of a mesh are jumps for; null: for nothing.
  const Pairs& at(std::size_t level) const { return levels_[level].pairs; }

  /// Whether a solution is to choose among all.
  bool may_narrow(std::size_t level) const {
    return levels_[level].all_pairs && !levels_[level].all_pairs->nodes.empty() && held_;
  }
  /// Jumps are where a displacement of that mesh nearly touches, or one of the next coarser mesh does; and, as long as
  /// these are most of them, where they were in the last solve.
  /// @return whether they are at other nodes now
  bool narrow(const Model<B>& model, std::size_t level, const std::vector<double>& u);
  void narrow_by_coarser(const Model<B>& model, std::size_t level, const std::vector<double>& u);
  /// Where a displacement of the finest mesh touches elsewhere as well jumps are there, too.
  /// @return whether it does
  bool widen(const Model<B>& model, const std::vector<double>& u);

  /// Interpolation between the meshes up to this one, `between` from the first one on, becomes one between the jumps
  /// that they have now.
  void connect(std::size_t level, std::span<Prolongation> between);

 private:
  /// Where bodies found each other, on the finest mesh.
  struct Place {
    std::vector<Point<B>> shift;
    Pairs all;
  };

  static Model<B> moved(Model<B> model, const std::vector<Point<B>>& shift);
  std::vector<Point<B>> shift_after(const Place& place, const Model<B>& model, const std::vector<double>& u) const;
  Prolongation interpolation(std::size_t level) const;
  bool held(const Model<B>& model) const;

  MeshLevels<D, B>& levels_;
  std::size_t first_ = 0;
  std::vector<Point<B>> shift_;
  Place accepted_;
  bool given_ = false;
  bool held_ = false;  // prescribed values hold all bodies
};

}  // namespace signorini
