#pragma once
// Grains at the border between ranks. A rank computes its own grains. It also holds ghosts: the surfaces of other
// ranks' grains near its own. Their positions arrive in every step while the elements of inner grains are computed. The
// force of a contact point is computed once, by the owner of the point's node, and its record goes to the owner of the
// facet. So the contact of a rank is a part of the contact that a single rank would have: the pairs that touch its own
// grains, in the same order, with the same numbers. Sums over them are the same to the last bit.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "solver/kernels/contact_state.hpp"
#include "solver/model/model.hpp"
#include "solver/parallel/communicator.hpp"

namespace mpfem {

/// The ghosts of one rank, and the messages about them.
class Ghosts {
public:
  /// `velocities`: contact needs the velocities of ghosts, too.
  Ghosts(const Communicator& ranks, bool velocities) : ranks_(&ranks), velocities_(velocities) {}

  // ---- at a search; all of these are collective
  /// Makes ghosts of the grains that belong to other ranks, and sets their current surfaces in the model.
  void choose(std::vector<std::int32_t> grains, Model& model);
  /// Sends pairs whose second grain belongs to another rank to that rank, and receives such pairs. Before the call
  /// `contact` has only own pairs. After it the ghosts are the second grains of own pairs, and the fixed data of the
  /// first grains of received pairs are known.
  void share_pairs(Model& model, Contact& contact);

  // ---- in a step
  /// Whether other ranks have this own grain as a ghost, or a pair with it: such grains are computed first.
  bool is_at_border(std::int32_t grain) const {
    return !at_border_.empty() && at_border_[static_cast<std::size_t>(grain)] != 0;
  }
  /// Starts to send positions, velocities and travel of own grains at the border, and to receive those of ghosts.
  void start_motion(const Model& model, const Contact& contact);
  /// Sets the ghosts' positions, velocities and travel.
  void finish_motion(Model& model, Contact& contact);
  /// Starts to send records of forces on ghosts, and to receive those on own grains.
  void start_forces(const Contact& contact);
  void finish_forces(Contact& contact);
  /// Moves messages on that have been started. To be called from the first thread while it computes.
  void progress() { transfer_.progress(); }

  const std::vector<std::int32_t>& grains() const { return ghosts_; }
  /// Bytes that this rank has sent in steps so far.
  std::int64_t bytes_sent() const { return bytes_sent_; }
  /// s that this rank has waited in steps for messages which had not arrived when they were needed.
  double waited() const { return waited_; }

private:
  /// What is sent to and received from one rank.
  struct Partner {
    int rank = 0;
    std::vector<std::int32_t> sent_grains, ghosts; ///< whose surfaces are sent and received
    std::vector<std::int32_t> sent_pairs, pairs;   ///< whose records are sent and received, indices into the candidates
    Bytes out, in;
    bool has_surfaces() const { return !sent_grains.empty() || !ghosts.empty(); }
    bool has_pairs() const { return !sent_pairs.empty() || !pairs.empty(); }
  };
  Partner& partner(int rank);
  static std::vector<std::int32_t> of_other_ranks(std::vector<std::int32_t> grains, const Model& model);
  template <class Give, class Visitor>
  void ask_owners(std::span<const std::int32_t> grains, const Model& model, const Give& give, const Visitor& visit);
  /// Collective. Sets in the model what never changes of grains of other ranks: facets and areas of nodes.
  void learn(std::vector<std::int32_t> grains, Model& model);
  void find_border(const Model& model);
  Communicator::Transfer start(bool (Partner::*concerns)() const);
  void await_messages();

  const Communicator* ranks_;
  bool velocities_;
  std::vector<std::int32_t> ghosts_; ///< ascending
  std::vector<char> known_;          ///< [grains]: whose facets are set in the model
  std::vector<char> at_border_;      ///< [grains]
  std::vector<Partner> partners_;    ///< by rank
  Communicator::Transfer transfer_;
  std::int64_t bytes_sent_ = 0;
  double waited_ = 0; ///< s
};

} // namespace mpfem
