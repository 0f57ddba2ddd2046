// A transaction of TLM-2.0 as a message.
#ifndef STRIDE_SYSTEMC_TRANSACTION_H
#define STRIDE_SYSTEMC_TRANSACTION_H

#include <cstdint>

#include <stride/unit/variable.h>

namespace stride::systemc {

/// A request, or its response, which is the request with the data that were read and a status.
///
/// The message is, with its numbers least significant byte first: 1 byte command, 1 byte status,
/// 2 bytes 0, 4 bytes size, 8 bytes address, and the data, except in the request of a read. The
/// data are in the order of their addresses.
struct Transaction {
  enum class Command : std::uint8_t { Read = 0, Write = 1 };
  /// As tlm::tlm_response_status.
  enum class Status : std::int8_t {
    Ok = 1,
    Incomplete = 0,  ///< of a request
    Error = -1,
    AddressError = -2,
    CommandError = -3,
    BurstError = -4,
    ByteEnableError = -5,
  };

  Command command = Command::Read;
  Status status = Status::Incomplete;
  std::uint64_t address = 0;
  std::uint32_t size = 0;  ///< of what is read or written [byte]
  Binary data;             ///< of `size` bytes, or empty
};

Binary encode(const Transaction& transaction);
/// Throws std::invalid_argument for bytes that are none.
Transaction decode_transaction(const Binary& message);

}  // namespace stride::systemc

#endif
