#define SC_INCLUDE_DYNAMIC_PROCESSES
#include <algorithm>
#include <numeric>
#include <stdexcept>

#include <stride/systemc/time.h>
#include <stride/systemc/tlm_rows.h>

namespace stride::systemc::detail {
namespace {

using Payload = tlm::tlm_generic_payload;

/// With room for what is read.
void fill(Payload& payload, Transaction& transaction) {
  const bool reads = transaction.command == Transaction::Command::Read;
  transaction.data.resize(transaction.size);
  payload.set_command(reads ? tlm::TLM_READ_COMMAND : tlm::TLM_WRITE_COMMAND);
  payload.set_address(transaction.address);
  payload.set_data_ptr(transaction.data.data());
  payload.set_data_length(transaction.size);
  payload.set_streaming_width(transaction.size);
  payload.set_byte_enable_ptr(nullptr);
  payload.set_dmi_allowed(false);
  payload.set_response_status(tlm::TLM_INCOMPLETE_RESPONSE);
}

Transaction request_of(const Payload& payload) {
  Transaction request;
  request.command = payload.is_write() ? Transaction::Command::Write : Transaction::Command::Read;
  request.address = payload.get_address();
  request.size = payload.get_data_length();
  const unsigned char* const data = payload.get_data_ptr();
  if (payload.is_write()) request.data.assign(data, data + request.size);
  return request;
}

bool is_enabled(const Payload& payload, unsigned byte) {
  const unsigned char* const enables = payload.get_byte_enable_ptr();
  return enables == nullptr || enables[byte % payload.get_byte_enable_length()] != 0;
}

std::string text_of(Transaction::Status status) {
  Payload payload;
  payload.set_response_status(static_cast<tlm::tlm_response_status>(status));
  return payload.get_response_string();
}

}  // namespace

void MemoryTarget::transport(Payload& payload, sc_core::sc_time& delay) {
  payload.set_dmi_allowed(false);
  if (payload.get_streaming_width() < payload.get_data_length()) {
    return payload.set_response_status(tlm::TLM_BURST_ERROR_RESPONSE);
  }
  if (debug(payload) < payload.get_data_length()) {
    return payload.set_response_status(tlm::TLM_ADDRESS_ERROR_RESPONSE);
  }
  delay += to_sc_time(latency_, ticks_per_picosecond());
  payload.set_dmi_allowed(true);
  payload.set_response_status(tlm::TLM_OK_RESPONSE);
}

bool MemoryTarget::direct(tlm::tlm_dmi& access) {
  if (bytes_.empty()) return false;
  const sc_core::sc_time latency = to_sc_time(latency_, ticks_per_picosecond());
  access.set_dmi_ptr(bytes_.data());
  access.set_start_address(0);
  access.set_end_address(bytes_.size() - 1);
  access.set_read_latency(latency);
  access.set_write_latency(latency);
  access.allow_read_write();
  return true;
}

unsigned MemoryTarget::debug(Payload& payload) {
  const std::uint64_t address = payload.get_address();
  const unsigned size = payload.get_data_length();
  if (address > bytes_.size() || size > bytes_.size() - address) return 0;
  for (unsigned i = 0; i < size; ++i) {
    if (!is_enabled(payload, i)) continue;
    if (payload.is_write()) bytes_[address + i] = payload.get_data_ptr()[i];
    if (payload.is_read()) payload.get_data_ptr()[i] = bytes_[address + i];
  }
  return size;
}

void RemoteTarget::reset() {
  send_.reset();
  pending_.clear();
}

void RemoteTarget::transport(Payload& payload, sc_core::sc_time& delay) {
  sc_core::wait(delay);  // the request leaves at its true instant
  delay = sc_core::SC_ZERO_TIME;
  Pending pending;
  pending_.push_back(&pending);
  (*send_)(encode(request_of(payload)));
  while (!pending.response) sc_core::wait(pending.done);
  const Transaction& response = *pending.response;
  payload.set_response_status(static_cast<tlm::tlm_response_status>(response.status));
  if (!payload.is_read()) return;
  const std::size_t size = std::min<std::size_t>(response.data.size(), payload.get_data_length());
  std::copy_n(response.data.begin(), size, payload.get_data_ptr());
}

void RemoteTarget::respond(Transaction response) {
  if (pending_.empty()) {
    throw std::invalid_argument("a response came, but no transaction waits for one");
  }
  Pending& pending = *pending_.front();
  pending_.pop_front();
  pending.response = std::move(response);
  pending.done.notify(sc_core::SC_ZERO_TIME);
}

void InitiatorRow::connect(Elaboration& elaboration) {
  jobs_.clear();
  port_ = connect_(elaboration, name());
  auto posted = std::make_shared<sc_core::sc_event>(sc_core::sc_gen_unique_name("posted"));
  posted_ = posted.get();
  elaboration.kernel().own(std::move(posted));
  sc_core::sc_spawn([this] { serve(); }, sc_core::sc_gen_unique_name("initiator"));
}

void InitiatorRow::post(Transaction request, Done done) {
  jobs_.push_back({std::move(request), std::move(done)});
  posted_->notify(sc_core::SC_ZERO_TIME);
}

void InitiatorRow::serve() {
  for (;;) {
    while (jobs_.empty()) sc_core::wait(*posted_);
    Job job = std::move(jobs_.front());
    jobs_.pop_front();
    perform(job);
  }
}

void InitiatorRow::perform(Job& job) {
  Payload payload;
  fill(payload, job.transaction);
  sc_core::sc_time delay;
  port_().b_transport(payload, delay);
  if (delay > sc_core::SC_ZERO_TIME) sc_core::wait(delay);
  job.transaction.status = static_cast<Transaction::Status>(payload.get_response_status());
  if (job.transaction.command == Transaction::Command::Write) job.transaction.data.clear();
  if (job.done) job.done(job.transaction);
}

Binary InitiatorRow::peek(const Register& place, const std::string& variable) {
  Transaction transaction;
  transaction.address = place.address;
  transaction.size = place.bytes;
  Payload payload;
  fill(payload, transaction);
  const unsigned size = port_().transport_dbg(payload);
  if (size == place.bytes) return transaction.data;
  throw std::runtime_error(variable + ": the target's transport_dbg() gives " +
                           std::to_string(size) + " of the " + std::to_string(place.bytes) +
                           " bytes at the address " + std::to_string(place.address) +
                           "; for a target without transport_dbg() use transactions()");
}

void require_ok(const Transaction& response, const std::string& variable) {
  if (response.status == Transaction::Status::Ok) return;
  throw std::runtime_error(variable + ": the write to the address " +
                           std::to_string(response.address) + " ended with " +
                           text_of(response.status));
}

Duration quantum_within(Duration from, Duration size, Duration longest) {
  constexpr int kMostParts = 100'000;
  const Duration whole = common_divisor(from, size);
  if (whole <= longest) return whole;
  const Picoseconds fewest = (whole + longest - Duration(1)) / longest;
  for (Picoseconds parts = fewest; parts < fewest + kMostParts; ++parts) {
    if (whole % parts == Duration()) return whole / parts;
  }
  return common_divisor(whole, longest);
}

}  // namespace stride::systemc::detail
