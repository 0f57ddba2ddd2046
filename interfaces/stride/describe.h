/* The content of Binary variables' values as human-readable text: an optional function beside the
 * FMI 3.0 table. A library that exports it gives the text of its messages; to an importer that does
 * not know it, the unit is a plain FMU.
 *
 * Clean as C11 and as C++17.
 */
#ifndef STRIDE_DESCRIBE_H
#define STRIDE_DESCRIBE_H

#include <stddef.h>

#include <stride/fmi3.h>

#ifdef __cplusplus
extern "C" {
#endif

/* In any state of the instance. Writes into `text`, which has room for `capacity` bytes, what
 * `value`, `size` bytes long, means as a value of this Binary variable, and into *textSize how many
 * bytes that are. The text is UTF-8 in one line, without control characters and without an end of
 * string; what does not fit is left out behind the last whole character that does.
 *
 * fmi3OK: it is there. fmi3Discard: the unit has no text for this variable or this value,
 * and *textSize is 0. Any other status is a misuse, such as a variable that is not Binary.
 *
 * The value is any that could have come, such as one with bit errors, or another unit's: all bytes
 * are allowed, and none of them is an error. The instance may use what it knows, such as the
 * question to which this is the answer, and is afterwards what it was before. */
typedef fmi3Status strideDescribeMessageTYPE(fmi3Instance instance, fmi3ValueReference variable,
                                             const fmi3Byte value[], size_t size, char text[],
                                             size_t capacity, size_t* textSize);

/* X(name) for each function stride<name> of type stride<name>TYPE. */
#define STRIDE_DESCRIBE_FUNCTIONS(X) X(DescribeMessage)

#ifdef __cplusplus
}
#endif

#endif
