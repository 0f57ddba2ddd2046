#include "master/front/api/elements.h"

#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#include "master/base/error.h"
#include "master/base/text/readable_text.h"

namespace stride::api {
namespace {

// the enumerations of the interface have the order of ours
static_assert(STRIDE_FLOAT32 == static_cast<int>(core::ValueType::Float32) &&
              STRIDE_UINT64 == static_cast<int>(core::ValueType::UInt64) &&
              STRIDE_STRING == static_cast<int>(core::ValueType::String) &&
              STRIDE_CLOCK == static_cast<int>(core::ValueType::Clock));
static_assert(STRIDE_PARAMETER == static_cast<int>(core::Causality::Parameter) &&
              STRIDE_INPUT == static_cast<int>(core::Causality::Input) &&
              STRIDE_INDEPENDENT == static_cast<int>(core::Causality::Independent));

}  // namespace

core::ValueBlock read_elements(const core::Variable& variable, const core::Context& context,
                               const void* elements) {
  core::ValueBlock value(variable.type, variable.size);
  core::visit(value, [&]<class T>(std::span<T> to) {
    for (std::size_t i = 0; i < to.size(); ++i) {
      if constexpr (std::is_same_v<T, std::string>) {
        const char* const text = static_cast<const char* const*>(elements)[i];
        if (text == nullptr) core::fail_input(context, "a text is NULL");
        if (!core::is_utf8(text)) core::fail_input(context, "a text is not UTF-8");
        to[i] = text;
      } else if constexpr (std::is_same_v<T, core::Binary>) {
        const stride_bytes& bytes = static_cast<const stride_bytes*>(elements)[i];
        if (bytes.size > 0 && bytes.data == nullptr) core::fail_input(context, "bytes are NULL");
        to[i].assign(bytes.data, bytes.data + bytes.size);
      } else if constexpr (std::is_same_v<T, bool>) {
        const std::uint8_t truth = static_cast<const std::uint8_t*>(elements)[i];
        if (truth > 1) core::fail_input(context, "a Boolean is neither 0 nor 1");
        to[i] = truth != 0;
      } else {
        to[i] = static_cast<const T*>(elements)[i];
      }
    }
  });
  return value;
}

CElements::CElements(core::ValueBlock value) : value_(std::move(value)) {
  if (value_->type() == core::ValueType::String) {
    for (const std::string& text : value_->strings()) strings_.push_back(text.c_str());
  } else if (value_->type() == core::ValueType::Binary) {
    for (const core::Binary& binary : value_->binaries()) {
      bytes_.push_back({reinterpret_cast<const std::uint8_t*>(binary.data()), binary.size()});
    }
  }
}

const void* CElements::data() const {
  if (!value_) return nullptr;
  if (!strings_.empty()) return strings_.data();
  if (!bytes_.empty()) return bytes_.data();
  return value_->bytes();
}

void CElements::copy_to(void* elements) const {
  const std::size_t size = !strings_.empty() ? sizeof(const char*)
                           : !bytes_.empty() ? sizeof(stride_bytes)
                                             : core::element_size(value_->type());
  std::memcpy(elements, data(), size * value_->size());
}

}  // namespace stride::api
