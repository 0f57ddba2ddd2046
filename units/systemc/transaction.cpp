#include <stdexcept>
#include <string>

#include <stride/systemc/transaction.h>

namespace stride::systemc {
namespace {

constexpr std::size_t kHeader = 16;

void put(Binary& message, std::uint64_t number, int bytes) {
  for (int i = 0; i < bytes; ++i) message.push_back(static_cast<std::uint8_t>(number >> 8 * i));
}

std::uint64_t get(const Binary& message, std::size_t at, std::size_t bytes) {
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < bytes; ++i) number |= std::uint64_t{message[at + i]} << 8 * i;
  return number;
}

}  // namespace

Binary encode(const Transaction& transaction) {
  Binary message;
  put(message, static_cast<std::uint8_t>(transaction.command), 1);
  put(message, static_cast<std::uint8_t>(transaction.status), 1);
  put(message, 0, 2);
  put(message, transaction.size, 4);
  put(message, transaction.address, 8);
  message.insert(message.end(), transaction.data.begin(), transaction.data.end());
  return message;
}

Transaction decode_transaction(const Binary& message) {
  if (message.size() < kHeader || message[0] > 1) {
    throw std::invalid_argument("a message of " + std::to_string(message.size()) +
                                " bytes is no transaction; <stride/systemc/transaction.h> has its "
                                "layout");
  }
  Transaction transaction;
  transaction.command = static_cast<Transaction::Command>(message[0]);
  transaction.status = static_cast<Transaction::Status>(message[1]);
  transaction.size = static_cast<std::uint32_t>(get(message, 4, 4));
  transaction.address = get(message, 8, 8);
  transaction.data.assign(message.begin() + kHeader, message.end());
  if (!transaction.data.empty() && transaction.data.size() != transaction.size) {
    throw std::invalid_argument("a transaction of " + std::to_string(transaction.size) +
                                " bytes has " + std::to_string(transaction.data.size()) +
                                " bytes of data");
  }
  return transaction;
}

}  // namespace stride::systemc
