#pragma once
#include "core/fem/elements/nodes.hpp"
#include "core/fem/recovery/contact.hpp"

namespace signorini {

/// How far bodies have slid past each other since they found each other, in the mean over what touches, in parts of
/// what is noticeable: of a twentieth of how far that reaches where they slide to, or of how differently nodes of one
/// side move, if that is more: then no body has slid as a whole. About so much of it touches other faces than the
/// solution takes.
/// @param masters nodes of the other bodies in contact
/// @param u global coordinates, D per node
/// @param shift by obstacle what they had slid then; empty: not
template <int D>
double noticeably_slid(const Nodes<D>& nodes, const Model<D>& model, const ContactState<D>& state,
                       const std::vector<ContactNode<D>>& masters, const std::vector<double>& u,
                       const std::vector<Point<D>>& shift);

}  // namespace signorini
