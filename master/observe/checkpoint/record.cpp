#include "master/observe/checkpoint/record.h"

#include <algorithm>
#include <cstring>
#include <string>

namespace stride::checkpoint {
namespace {

/// Which elements of a list follow; with its number.
enum Extent : std::uint8_t { kNone, kSome, kAll, kExtents };

/// Whether the bits are the same, as -0 and 0 have not.
template <class T>
bool has_same_bits(const T& a, const T& b) {
  if constexpr (std::is_arithmetic_v<T>) return std::memcmp(&a, &b, sizeof a) == 0;
  return a == b;
}

template <class T>
std::size_t changes(std::span<const T> values, std::span<const T> before) {
  if constexpr (std::is_arithmetic_v<T>) {
    if (std::memcmp(values.data(), before.data(), values.size_bytes()) == 0) return 0;
  }
  std::size_t count = 0;
  for (std::size_t i = 0; i < values.size(); ++i) count += !has_same_bits(values[i], before[i]);
  return count;
}

template <class T>
void put_element(RecordWriter& record, const T& element) {
  if constexpr (std::is_arithmetic_v<T>) {
    record.put_bytes(std::as_bytes(std::span(&element, 1)));
  } else {
    record.put_count(element.size());
    record.put_bytes(std::as_bytes(std::span(element.data(), element.size())));
  }
}

template <class T>
void put_all(RecordWriter& record, std::span<const T> values) {
  if constexpr (std::is_arithmetic_v<T>) {
    record.put_bytes(std::as_bytes(values));
  } else {
    for (const T& element : values) put_element(record, element);
  }
}

/// Eight elements at a time: a bit for each that changes, and those.
template <class T>
void put_some(RecordWriter& record, std::span<const T> values, std::span<const T> before) {
  for (std::size_t first = 0; first < values.size(); first += 8) {
    const std::size_t count = std::min<std::size_t>(8, values.size() - first);
    std::uint8_t changed = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const bool is_same = has_same_bits(values[first + i], before[first + i]);
      changed |= static_cast<std::uint8_t>(static_cast<unsigned>(!is_same) << i);
    }
    record.put(changed);
    for (std::size_t i = 0; i < count; ++i) {
      if ((changed >> i & 1U) != 0) put_element(record, values[first + i]);
    }
  }
}

}  // namespace

// ---- Writing ----

void RecordWriter::put_values(VariableLists::Number number, VariableList& list,
                              const core::ValueBlock& values) {
  core::ValueBlock& kept = list.set_block();
  core::visit(values, [&]<class T>(std::span<const T> now) {
    core::visit(kept, [&]<class U>(std::span<U> before) {
      if constexpr (std::is_same_v<T, U>) {
        const std::span<const T> old(before);
        const std::size_t changed = list.is_known ? changes(now, old) : now.size();
        const bool are_few = changed < now.size() - now.size() / 8;
        const Extent extent = changed == 0 && list.is_known ? kNone : are_few ? kSome : kAll;
        put_count(std::uint64_t{number} * kExtents + extent);
        if (extent == kSome) put_some(*this, now, old);
        if (extent == kAll) put_all(*this, now);
        if (extent != kNone) std::ranges::copy(now, before.begin());
      }
    });
  });
  list.is_known = true;
}

// ---- Reading ----

Call RecordReader::next_call() {
  const auto byte = static_cast<std::uint8_t>(bytes_.peek());
  if (byte >= static_cast<std::uint8_t>(Call::End)) {
    throw core::BadState("the journal has a call that does not exist");
  }
  return static_cast<Call>(byte);
}

Call RecordReader::take_call() {
  const Call call = next_call();
  take();
  return call;
}

template <class Count>
Count RecordReader::take_digits() {
  Count count = 0;
  for (int shift = 0; shift < static_cast<int>(8 * sizeof(Count)); shift += 7) {
    const Count byte = take();
    count |= (byte & 0x7F) << shift;
    if (byte < 0x80) return count;
  }
  throw core::BadState("the journal has a number that is too long");
}

std::uint64_t RecordReader::take_count() { return take_digits<std::uint64_t>(); }

Duration RecordReader::take_duration() {
  const Wide count = take_digits<Wide>();
  return Duration(static_cast<Picoseconds>((count >> 1) ^ (~(count & 1) + 1)));
}

VariableLists::Number RecordReader::take_number(const VariableLists& lists) {
  const std::uint64_t number = take_count();
  if (number >= lists.size()) throw core::BadState("the journal has a list that does not exist");
  return static_cast<VariableLists::Number>(number);
}

VariableList& RecordReader::take_values(VariableLists& lists) {
  const std::uint64_t code = take_count();
  if (code / kExtents >= lists.size()) {
    throw core::BadState("the journal has a list that does not exist");
  }
  VariableList& list = lists[static_cast<VariableLists::Number>(code / kExtents)];
  const auto extent = static_cast<Extent>(code % kExtents);
  if (extent != kAll && !list.is_known) {
    throw core::BadState("the journal refers to values that it does not have");
  }
  if (extent != kNone) take_elements(list, extent == kAll);
  list.is_known = true;
  return list;
}

/// A text or bytes, in pieces: no more memory than there are bytes for.
void RecordReader::take_sequence(auto& element) {
  constexpr std::uint64_t kPiece = std::uint64_t{64} << 10;
  std::uint64_t left = take_count();
  element.clear();
  while (left > 0) {
    const std::uint64_t count = std::min(left, kPiece);
    const std::size_t before = element.size();
    element.resize(before + count);
    bytes_.take(element.data() + before, count);
    left -= count;
  }
}

void RecordReader::take_elements(VariableList& list, bool are_all) {
  core::visit(list.set_block(), [&]<class T>(std::span<T> elements) {
    unsigned changed = 0xFF;
    for (std::size_t i = 0; i < elements.size(); ++i) {
      if (!are_all && i % 8 == 0) changed = take();
      if ((changed >> i % 8 & 1U) == 0) continue;
      if constexpr (std::is_same_v<T, bool>) {
        elements[i] = take() != 0;
      } else if constexpr (std::is_arithmetic_v<T>) {
        bytes_.take(&elements[i], sizeof(T));
      } else {
        take_sequence(elements[i]);
      }
    }
  });
}

}  // namespace stride::checkpoint
