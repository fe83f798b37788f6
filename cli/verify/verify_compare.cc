#include "cli/verify/verify_compare.h"

#include <algorithm>
#include <cstring>

#include "cli/verify/verify_text.h"

namespace carom::cli {
namespace {

// Index of the first element that differs in any bit, or is only in one of the lists.
template <class T>
std::optional<size_t> first_difference(std::span<const T> expected, std::span<const T> actual) {
  size_t common = std::min(expected.size(), actual.size());
  for (size_t i = 0; i < common; ++i) {
    if (std::memcmp(&expected[i], &actual[i], sizeof(T)) != 0) return i;
  }
  if (expected.size() == actual.size()) return std::nullopt;
  return common;
}

Pair pair_of(Pair pair) { return pair; }
Pair pair_of(const Contact& contact) { return {contact.a, contact.b}; }
Pair pair_of(const Event& event) { return {event.a.index, event.b.index}; }
Pair pair_of(BodyId id) { return {id.index, id.index}; }

// Lists are sorted: at the first difference the other list lacks the lesser pair.
template <class T>
std::optional<Mismatch> compare_lists(const char* what, std::span<const T> expected,
                                      std::span<const T> actual) {
  std::optional<size_t> index = first_difference(expected, actual);
  if (!index) return std::nullopt;
  if (*index >= expected.size()) return Mismatch{what, pair_of(actual[*index])};
  if (*index >= actual.size()) return Mismatch{what, pair_of(expected[*index])};
  return Mismatch{what, std::min(pair_of(expected[*index]), pair_of(actual[*index]))};
}

// One value for each pair; the pairs are known to agree.
std::optional<Mismatch> compare_overlaps(const FrameView& expected, const FrameView& actual) {
  std::optional<size_t> index = first_difference(expected.overlaps, actual.overlaps);
  if (!index) return std::nullopt;
  size_t last = expected.pairs.empty() ? 0 : expected.pairs.size() - 1;
  return Mismatch{"overlaps",
                  expected.pairs.empty() ? Pair{0, 0} : expected.pairs[std::min(*index, last)]};
}

// One value for each contact; the contacts are known to agree.
std::optional<Mismatch> compare_manifolds(const FrameView& expected, const FrameView& actual) {
  std::optional<size_t> index = first_difference(expected.manifolds, actual.manifolds);
  if (!index) return std::nullopt;
  const std::span<const Contact> contacts = expected.contacts;
  if (contacts.empty()) return Mismatch{"manifolds", {0, 0}};
  return Mismatch{"manifolds", pair_of(contacts[std::min(*index, contacts.size() - 1)])};
}

template <class T>
const T* find(std::span<const T> list, Pair pair) {
  auto found = std::find_if(list.begin(), list.end(),
                            [&](const T& entry) { return pair_of(entry) == pair; });
  return found == list.end() ? nullptr : &*found;
}

std::string event_text(const Event& event) {
  constexpr const char* kEventNames[kEventKindCount] = {"begin", "persist", "end", "impact"};
  return std::string(kEventNames[static_cast<size_t>(event.kind)]) +
         (event.sensor ? " of a sensor" : "") + ", gone " + std::to_string(event.gone) +
         ", contact " + (event.contact == kNoContact ? "none" : std::to_string(event.contact));
}

std::string manifold_text(const FrameView& frame, const Contact& contact) {
  const auto index = static_cast<size_t>(&contact - frame.contacts.data());
  if (index >= frame.manifolds.size()) return "";
  return ": " + text_of(frame.manifolds[index]);
}

std::string findings(const FrameView& frame, Pair pair) {
  if (pair.a == pair.b) {
    return find(frame.quarantined, pair) ? "quarantined" : "not quarantined";
  }
  const Pair* candidate = find(frame.pairs, pair);
  std::string text = candidate ? "candidate pair" : "no candidate pair";
  size_t index = candidate ? static_cast<size_t>(candidate - frame.pairs.data()) : 0;
  if (candidate && index < frame.overlaps.size()) {
    text += ", overlap " + std::to_string(frame.overlaps[index]);
  }
  const Event* event = find(frame.events, pair);
  text += ", event " + (event ? event_text(*event) : "none");
  const Contact* contact = find(frame.contacts, pair);
  text += ", contact " + (contact ? text_of(*contact) : "none");
  return contact ? text + manifold_text(frame, *contact) : text;
}

const BodyDesc* find_body(std::span<const reference::Body> bodies, uint32_t index) {
  for (const reference::Body& body : bodies) {
    if (body.id.index == index) return &body.desc;
  }
  return nullptr;
}

std::string describe_body(std::span<const reference::Body> bodies, uint32_t index,
                          PositionType positions) {
  const BodyDesc* body = find_body(bodies, index);
  std::string head = "  body " + std::to_string(index) + ": ";
  if (!body) return head + "does not exist\n";
  return head + text_of(*body, positions) + "\n    bounds " +
         text_of(reference::bounds(body->shape, {body->position, body->orientation}, positions)) +
         '\n';
}

}  // namespace

FrameView view_of(const reference::Frame& frame) {
  return {frame.pairs,     frame.overlaps, frame.contacts,
          frame.manifolds, frame.events,   frame.quarantined};
}

std::optional<Mismatch> compare(const FrameView& expected, const FrameView& actual) {
  auto mismatch = compare_lists("quarantined", expected.quarantined, actual.quarantined);
  if (!mismatch) mismatch = compare_lists("pairs", expected.pairs, actual.pairs);
  if (!mismatch) mismatch = compare_overlaps(expected, actual);
  if (!mismatch) mismatch = compare_lists("contacts", expected.contacts, actual.contacts);
  if (!mismatch) mismatch = compare_manifolds(expected, actual);
  if (!mismatch) mismatch = compare_lists("events", expected.events, actual.events);
  return mismatch;
}

std::string describe(const Mismatch& mismatch, std::span<const reference::Body> bodies,
                     PositionType positions, const FrameView& expected, const FrameView& actual) {
  const Pair pair = mismatch.pair;
  std::string text = describe_body(bodies, pair.a, positions);
  if (pair.b != pair.a) text += describe_body(bodies, pair.b, positions);
  text += "  reference: " + findings(expected, pair) + '\n';
  text += "  carom:     " + findings(actual, pair) + '\n';
  return text;
}

}  // namespace carom::cli
