#include "solver/run/ghosts.hpp"

#include <algorithm>

#include "common/index.hpp"
#include "solver/kernels/contact_candidates.hpp"
#include "solver/run/profile.hpp"

namespace mpfem {

namespace {

using Index = std::int32_t;

/// Surface nodes of a grain in an array of `width` numbers a node.
template <class Array>
auto surface_part(Array& values, const Model& model, Index grain, std::size_t width = 1) {
  return std::span(values.data() + width * model.first_node(grain), width * at(model.surface_node_count[at(grain)]));
}

/// Calls visit(values) for the arrays of a grain's surface that never change.
template <class ModelType, class Visitor>
void for_each_fixed_part(ModelType& model, Index grain, Visitor&& visit) {
  const std::size_t first = 3 * at(model.facet_offset[at(grain)]), end = 3 * at(model.facet_offset[at(grain) + 1]);
  visit(std::span(model.facet.data() + first, end - first));
  visit(surface_part(model.reference_area, model, grain));
  if (!model.refinement.empty()) visit(surface_part(model.refinement, model, grain));
}

/// The same for the arrays that change with motion; velocities only if contact has friction.
template <class ModelType, class Visitor>
void for_each_moving_part(ModelType& model, Index grain, bool velocities, Visitor&& visit) {
  visit(surface_part(model.position, model, grain, 4));
  if (velocities) visit(surface_part(model.velocity, model, grain, 4));
}

/// Appends any values to a message.
constexpr auto appended_to = [](Bytes& message) {
  return [&message](auto values) { append(message, std::span<const typename decltype(values)::value_type>(values)); };
};

std::size_t bytes_of_motion(const Model& model, std::span<const Index> grains, bool velocities) {
  std::size_t bytes = grains.size() * sizeof(double); // travel
  for (const Index g : grains)
    for_each_moving_part(model, g, velocities, [&](auto values) { bytes += values.size_bytes(); });
  return bytes;
}

/// The candidates of one pair.
void append_pair(const ContactCandidates& candidates, std::size_t pair, Bytes& message) {
  const Index first = candidates.pair_point_offset[pair], end = candidates.pair_point_offset[pair + 1];
  append(message, candidates.pair_first[pair]);
  append(message, candidates.pair_second[pair]);
  append(message, end - first);
  for (Index p = first; p < end; ++p) {
    const Index from = candidates.point_facet_offset[at(p)], to = candidates.point_facet_offset[at(p) + 1];
    append(message, candidates.point_node[at(p)]);
    append(message, to - from);
    append(message, std::span<const Index>(candidates.point_facet.data() + from, at(to - from)));
  }
}

/// A pair received from another rank.
struct PairOfOther {
  Index first, second;
  std::vector<Index> node, facets, facet; ///< of each point; number for each point; all facets in a row
};

PairOfOther take_pair(MessageReader& message) {
  PairOfOther pair{message.take<Index>(), message.take<Index>(), {}, {}, {}};
  for (Index points = message.take<Index>(); points > 0; --points) {
    pair.node.push_back(message.take<Index>());
    pair.facets.push_back(message.take<Index>());
    const std::size_t before = pair.facet.size();
    pair.facet.resize(before + at(pair.facets.back()));
    message.take(std::span(pair.facet).subspan(before));
  }
  return pair;
}

ContactCandidates joined(std::vector<PairOfOther>&& pairs, int grains) {
  std::sort(pairs.begin(), pairs.end(), [](const PairOfOther& a, const PairOfOther& b) {
    return std::pair(a.first, a.second) < std::pair(b.first, b.second);
  });
  ContactCandidates result;
  result.pair_point_offset.push_back(0);
  result.point_facet_offset.push_back(0);
  for (const PairOfOther& pair : pairs) {
    result.pair_first.push_back(pair.first);
    result.pair_second.push_back(pair.second);
    result.point_node.insert(result.point_node.end(), pair.node.begin(), pair.node.end());
    result.point_facet.insert(result.point_facet.end(), pair.facet.begin(), pair.facet.end());
    offset_after(result.point_facet); // before the sums overflow
    for (const Index facets : pair.facets)
      result.point_facet_offset.push_back(result.point_facet_offset.back() + facets);
    result.pair_point_offset.push_back(offset_after(result.point_node));
  }
  index_pairs(result, grains);
  return result;
}

/// The most bytes that the force records of one pair may take, with their counts.
std::size_t most_bytes(const Contact& contact, Index pair) {
  const ContactCandidates& candidates = contact.candidates;
  const std::size_t points = at(candidates.pair_point_offset[at(pair) + 1] - candidates.pair_point_offset[at(pair)]);
  return 2 * sizeof(Index) + (contact.bonding() ? 2 : 1) * points * sizeof(ContactForce);
}

} // namespace

Ghosts::Partner& Ghosts::partner(int rank) {
  const auto place = std::lower_bound(partners_.begin(), partners_.end(), rank,
                                      [](const Partner& p, int wanted) { return p.rank < wanted; });
  if (place != partners_.end() && place->rank == rank) return *place;
  Partner fresh;
  fresh.rank = rank;
  return *partners_.insert(place, std::move(fresh));
}

/// The grains of other ranks among `grains`, ascending, each once.
std::vector<Index> Ghosts::of_other_ranks(std::vector<Index> grains, const Model& model) {
  std::erase_if(grains, [&](Index g) { return model.ownership.owns(g); });
  std::sort(grains.begin(), grains.end());
  grains.erase(std::unique(grains.begin(), grains.end()), grains.end());
  return grains;
}

/// Each rank names grains, and their owners answer with arrays of their surfaces. visit(grain, take) is called for each
/// of `grains` with take(values), which sets values from the answer; give(rank, grain, message) appends them there.
template <class Give, class Visitor>
void Ghosts::ask_owners(std::span<const Index> grains, const Model& model, const Give& give, const Visitor& visit) {
  std::vector<Bytes> wanted(static_cast<std::size_t>(ranks_->size()));
  for (const Index g : grains) append(wanted[at(model.ownership.owner[at(g)])], g);
  const std::vector<Bytes> asked = ranks_->exchange(wanted);
  std::vector<Bytes> answer(asked.size());
  for (std::size_t rank = 0; rank < asked.size(); ++rank)
    for (MessageReader reader(asked[rank]); !reader.done();)
      give(static_cast<int>(rank), reader.take<Index>(), answer[rank]);
  const std::vector<Bytes> surfaces = ranks_->exchange(answer);
  std::vector<MessageReader> readers(surfaces.begin(), surfaces.end());
  for (const Index g : grains) visit(g, [&](auto values) { readers[at(model.ownership.owner[at(g)])].take(values); });
}

void Ghosts::learn(std::vector<Index> grains, Model& model) {
  if (known_.empty()) known_.assign(at(model.grains), 0);
  grains = of_other_ranks(std::move(grains), model);
  std::erase_if(grains, [&](Index g) { return known_[at(g)] != 0; });
  if (ranks_->largest(static_cast<double>(grains.size())) == 0) return; // as nearly always, after the first search
  ask_owners(
      grains, model, [&](int, Index g, Bytes& message) { for_each_fixed_part(model, g, appended_to(message)); },
      [&](Index g, const auto& take) { for_each_fixed_part(model, g, take), known_[at(g)] = 1; });
}

void Ghosts::choose(std::vector<Index> grains, Model& model) {
  if (ranks_->alone()) return;
  ghosts_ = of_other_ranks(std::move(grains), model);
  learn(ghosts_, model);
  for (Partner& p : partners_) p.sent_grains.clear(), p.ghosts.clear();
  for (const Index g : ghosts_) partner(model.ownership.owner[at(g)]).ghosts.push_back(g);
  ask_owners(
      ghosts_, model,
      [&](int rank, Index g, Bytes& message) {
        partner(rank).sent_grains.push_back(g);
        for_each_moving_part(model, g, velocities_, appended_to(message));
      },
      [&](Index g, const auto& take) { for_each_moving_part(model, g, velocities_, take); });
}

void Ghosts::share_pairs(Model& model, Contact& contact) {
  if (ranks_->alone()) return;
  const ContactCandidates& candidates = contact.candidates;
  std::vector<Index> seconds;
  std::vector<Bytes> given(static_cast<std::size_t>(ranks_->size()));
  for (std::size_t pair = 0; pair < candidates.pair_first.size(); ++pair) {
    const Index second = candidates.pair_second[pair];
    if (model.ownership.owns(second)) continue;
    append_pair(candidates, pair, given[at(model.ownership.owner[at(second)])]);
    seconds.push_back(second);
  }
  std::vector<PairOfOther> pairs;
  std::vector<Index> firsts;
  for (const Bytes& bytes : ranks_->exchange(given))
    for (MessageReader reader(bytes); !reader.done();) {
      pairs.push_back(take_pair(reader));
      firsts.push_back(pairs.back().first);
    }
  learn(std::move(firsts), model); // the stable step of the second grain depends on the areas of the first one's nodes
  add_pairs(model, joined(std::move(pairs), model.grains), contact);
  choose(std::move(seconds), model);

  // Both sides have the pairs between them in the same order.
  for (Partner& p : partners_) p.sent_pairs.clear(), p.pairs.clear();
  for (std::size_t pair = 0; pair < contact.candidates.pair_first.size(); ++pair) {
    const Index first = contact.candidates.pair_first[pair], second = contact.candidates.pair_second[pair];
    if (!model.ownership.owns(second))
      partner(model.ownership.owner[at(second)]).sent_pairs.push_back(static_cast<Index>(pair));
    else if (!model.ownership.owns(first))
      partner(model.ownership.owner[at(first)]).pairs.push_back(static_cast<Index>(pair));
  }
  find_border(model);
  for (const Partner& p : partners_)
    for (const Index pair : p.sent_pairs) at_border_[at(contact.candidates.pair_first[at(pair)])] = 1;
}

void Ghosts::find_border(const Model& model) {
  at_border_.assign(ranks_->alone() ? 0 : at(model.grains), 0);
  for (const Partner& p : partners_)
    for (const Index g : p.sent_grains) at_border_[at(g)] = 1;
}

Communicator::Transfer Ghosts::start(bool (Partner::*concerns)() const) {
  std::vector<Communicator::Outgoing> out;
  std::vector<Communicator::Incoming> in;
  for (Partner& p : partners_) {
    if (!(p.*concerns)()) continue;
    out.push_back({p.rank, p.out});
    in.push_back({p.rank, p.in});
    bytes_sent_ += static_cast<std::int64_t>(p.out.size());
  }
  return ranks_->start(out, in);
}

void Ghosts::await_messages() {
  const auto start = Profile::Clock::now();
  transfer_.finish();
  waited_ += Profile::since(start);
}

void Ghosts::start_motion(const Model& model, const Contact& contact) {
  if (partners_.empty()) return;
  for (Partner& p : partners_) {
    p.out.clear();
    for (const Index g : p.sent_grains) {
      for_each_moving_part(model, g, velocities_, appended_to(p.out));
      append(p.out, contact.travel[at(g)]);
    }
    p.in.resize(bytes_of_motion(model, p.ghosts, velocities_));
  }
  transfer_ = start(&Partner::has_surfaces);
}

void Ghosts::finish_motion(Model& model, Contact& contact) {
  if (partners_.empty()) return;
  await_messages();
  for (const Partner& p : partners_) {
    MessageReader reader(p.in);
    for (const Index g : p.ghosts) {
      for_each_moving_part(model, g, velocities_, [&](auto part) { reader.take(part); });
      contact.travel[at(g)] = reader.take<double>();
    }
  }
}

void Ghosts::start_forces(const Contact& contact) {
  if (partners_.empty()) return;
  for (Partner& p : partners_) {
    p.out.clear();
    for (const Index pair : p.sent_pairs)
      for (const auto records : {contact.active_points(pair), contact.pulling_bonds(pair)}) {
        append(p.out, static_cast<Index>(records.size()));
        append(p.out, records);
      }
    std::size_t most = 0;
    for (const Index pair : p.pairs) most += most_bytes(contact, pair);
    p.in.resize(most);
  }
  transfer_ = start(&Partner::has_pairs);
}

void Ghosts::finish_forces(Contact& contact) {
  if (partners_.empty()) return;
  await_messages();
  for (const Partner& p : partners_) {
    MessageReader reader(p.in);
    for (const Index pair : p.pairs) {
      const auto first = at(contact.candidates.pair_point_offset[at(pair)]);
      const auto active = contact.active[at(pair)] = reader.take<Index>();
      reader.take(std::span(contact.force).subspan(first, at(active)));
      const auto pulling = reader.take<Index>();
      if (!contact.bonding()) continue;
      contact.pulling[at(pair)] = pulling;
      reader.take(std::span(contact.bond_force).subspan(first, at(pulling)));
    }
  }
}

} // namespace mpfem
