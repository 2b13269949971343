/* SPDX-License-Identifier: Apache-2.0
 *
 * What every object starts with, and the checks that every call begins with.
 */
#ifndef FR_OBJECT_H
#define FR_OBJECT_H

#include "floatref.h"

/* A kind of object. The size of fr_real is part of it, so that a copy from the other build of the
 * library is no object. */
#define FR_MAGIC(number) ((uint32_t)0x46520000u + (uint32_t)(number) * 16u + (uint32_t)sizeof(fr_real))

enum { FR_STATE_RUNNING = 1, FR_STATE_ENDED = 2 };

/* More samples than this are a size that has run over. */
#define FR_MOST_SAMPLES (SIZE_MAX / 64u)

/* No object is larger; tests build for less, as a small core has. */
#ifndef FR_MOST_BYTES
#define FR_MOST_BYTES SIZE_MAX
#endif

/* A state that was saved by another version may have another layout. */
#define FR_SAVED_BY (FR_VERSION_MAJOR * 10000 + FR_VERSION_MINOR * 100 + FR_VERSION_PATCH)

typedef struct fr_head {
    uint32_t magic;
    uint16_t version;
    uint16_t state;
} fr_head;

/* Bytes of a struct, so that an array of int64_t or fr_real behind it is aligned. */
#define FR_PADDED(type) ((sizeof(type) + (FR_ALIGNMENT - 1u)) / FR_ALIGNMENT * FR_ALIGNMENT)

/* Bytes of `fixed`, and of `number` items of `item` behind it; 0 if no object is so large. */
static inline size_t fr_sized(size_t fixed, uint64_t number, size_t item)
{
    uint64_t most = ((uint64_t)FR_MOST_BYTES - fixed) / item;
    return fixed <= FR_MOST_BYTES && number <= most ? fixed + (size_t)number * item : 0u;
}

/* Where that array starts. */
#define FR_BEHIND(object, type) ((void *)((unsigned char *)(object) + FR_PADDED(type)))

/* Whether an object that needs `needed` bytes, 0 for a bad configuration, can be placed; if so its
 * memory is cleared and the head is written. */
fr_status fr_place(void *memory, size_t size, const void *config, const void *out, size_t needed,
                   uint32_t magic);

/* Whether `object` starts with the head of a running object of this kind. */
fr_status fr_ready(const void *object, uint32_t magic);

/* The same of an object whose run may have ended: its results are still there. */
fr_status fr_readable(const void *object, uint32_t magic);

/* Say that nothing is written: every call begins with it, and refuses what it refuses later. */
static inline void fr_nothing(size_t *written)
{
    if (written != NULL)
        *written = 0u;
}

/* Whether `count` samples fit into `y`. */
fr_status fr_room(size_t count, const void *y, size_t capacity, size_t *written);

#endif
