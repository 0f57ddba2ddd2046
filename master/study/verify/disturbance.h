#ifndef STRIDE_MASTER_STUDY_VERIFY_DISTURBANCE_H
#define STRIDE_MASTER_STUDY_VERIFY_DISTURBANCE_H

namespace stride::verify {

/// Makes this process unlike its sisters: fresh memory is not zero, and libraries and heap blocks
/// are at other addresses.
void disturb();

}  // namespace stride::verify

#endif
