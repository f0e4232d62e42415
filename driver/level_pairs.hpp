#pragma once
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "core/fem/model.hpp"
#include "core/fem/paired_bodies.hpp"
#include "core/mesh/mesh.hpp"
#include "core/solver/prolongation.hpp"

namespace signorini {

/// Where, on each mesh, unknowns are jumps between bodies that may touch each other: where a solution says that they
/// nearly do, and all over the slaves where prescribed values do not hold all bodies.
template <int D, int B>
class LevelPairs {
 public:
  using Pairs = std::shared_ptr<const PairedBodies<B>>;

  /// Keeps references.
  /// @param nodes of each mesh
  /// @param first the coarsest mesh that is a level
  LevelPairs(const MeshHierarchy<D>& hierarchy, const std::vector<Nodes<D>>& nodes, std::size_t first)
      : hierarchy_(hierarchy), nodes_(nodes), first_(first) {
    all_.resize(nodes.size());
    chosen_.resize(nodes.size());
    connected_.resize(hierarchy.refinements.size());
  }

  /// Of a new model all that may touch; to be called where is_paired(). In the first load step as the undeformed bodies
  /// lie to each other. Where nothing but gaps is new unknowns stay what they are.
  /// @return whether they stay
  bool find(const Model<B>& model);

  /// In a load step that follows another one: where a displacement of the finest mesh has taken bodies past each other,
  /// in the mean of where they nearly touch, by a part of an element since they last found each other, find() finds
  /// them there from now on. That depends on the displacement and on where they found each other, not on where
  /// unknowns are jumps: these are others for every start and hierarchy.
  /// @return whether it has
  bool follow(const Model<B>& model, const std::vector<double>& u);
  /// Whether it would.
  bool would_follow(const Model<B>& model, const std::vector<double>& u) const {
    return shift_after({shift_, all_.back()}, model, u) != shift_;
  }

  /// Steps after this one begin from where bodies have found each other now.
  void accept() { accepted_ = {shift_, all_.back()}; }
  /// Such a step begins, or begins again, with the last one's displacement: follows it from there.
  void begin_step(const Model<B>& model, const std::vector<double>& u) { shift_ = shift_after(accepted_, model, u); }
  /// Steps begin from where those of another one's do.
  void come_after(const LevelPairs& other) { accepted_ = other.accepted_; }

  /// From now on these are all that may touch, per mesh, whatever the model says.
  void give(std::vector<Pairs> pairs);
  bool given() const { return given_; }
  const std::vector<Pairs>& all() const { return all_; }

  /// Per obstacle by how much slaves were taken to have moved past masters when they found each other; empty: not.
  const std::vector<Point<B>>& shift() const { return shift_; }

  /// What unknowns of a mesh are jumps for; null: for nothing.
  const Pairs& at(std::size_t level) const { return chosen_[level]; }

  /// Whether a solution is to choose among all.
  bool may_narrow(std::size_t level) const { return all_[level] && held_; }
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

  std::vector<Point<B>> shift_after(const Place& place, const Model<B>& model, const std::vector<double>& u) const;
  Prolongation interpolation(std::size_t refinement) const;
  bool held(const Model<B>& model) const;

  const MeshHierarchy<D>& hierarchy_;
  const std::vector<Nodes<D>>& nodes_;
  const std::size_t first_;
  std::vector<Pairs> all_, chosen_;  // per mesh
  std::vector<Point<B>> shift_;
  Place accepted_;
  std::vector<std::array<std::shared_ptr<const Jumps<B>>, 2>> connected_;  // per refinement: of the interpolation
  bool given_ = false;
  bool held_ = false;  // prescribed values hold all bodies
};

}  // namespace signorini
