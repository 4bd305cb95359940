#include "solver/output/numbering_hash.hpp"

#include <algorithm>
#include <cstring>

#include "common/hash.hpp"
#include "common/index.hpp"
#include "solver/output/gathered_file.hpp"

namespace mpfem {

namespace {

/// On the first rank: hash of all nodes' or tets' places in the packing file; first[g] is the first of a grain.
std::uint64_t hash_at_root(const Communicator& ranks, const Model& model, const LazyArray<std::int32_t>& file_place,
                           std::span<const std::int32_t> first, std::uint64_t seed) {
  StreamingHash hash(seed);
  gather_at_root<std::int32_t>(
      ranks, model.ownership, rows_of_grains(first),
      [&](std::int32_t grain, std::span<std::int32_t> values) {
        std::copy_n(file_place.begin() + first[at(grain)], values.size(), values.begin());
      },
      [&](std::span<const std::int32_t> piece) { hash.update(std::as_bytes(piece)); });
  return hash.value();
}

} // namespace

std::uint64_t numbering_hash(const Communicator& ranks, const Model& model) {
  const std::uint64_t of_nodes = hash_at_root(ranks, model, model.file_node, model.node_offset, hash_seed);
  std::uint64_t hash = hash_at_root(ranks, model, model.file_tet, model.tet_offset, of_nodes);
  Bytes message(sizeof hash);
  std::memcpy(message.data(), &hash, sizeof hash);
  ranks.broadcast_from_root(message);
  std::memcpy(&hash, message.data(), sizeof hash);
  return hash;
}

} // namespace mpfem
