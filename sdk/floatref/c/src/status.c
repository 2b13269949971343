/* SPDX-License-Identifier: Apache-2.0
 *
 * Statuses in English, the version, and the checks of memory and calls.
 */
#include <string.h>

#include "object.h"

#define FR_TEXT(number) #number
#define FR_DOTTED(major, minor, patch) FR_TEXT(major) "." FR_TEXT(minor) "." FR_TEXT(patch)

const char *fr_status_text(fr_status status)
{
    static const char *const texts[] = {
        "the call did its work",
        "a pointer is NULL; give the address of every argument",
        "the memory is too small; give as many bytes as the size function says",
        "the memory is not aligned; start it at a multiple of FR_ALIGNMENT bytes",
        "the memory holds no object of this kind and build; initialize it first",
        "the call is out of order, or has no value yet; after the end of a run initialize a new object",
        "a setting is out of its range; start from the defaults and set what has no default",
        "a sample is infinite, missing or out of its range; repair it and push again",
        "a cut-off is not within zero to half the sampling rate; give the speed in m/s",
        "the encoder counts go back; push every chunk once, and the farthest count so far",
        "the output has no room; give as many samples as *written says",
        "more samples than one push may have; push fewer, or see whether the count has run over",
        "not all signals of the set have passed; the motion of the vehicle would not cancel",
        "signals of one set were given different speeds; give all of them the same",
        "the sample of the GNSS reading has been filtered, or has one; raise late_s, or leave it out",
        "too many GNSS readings wait; push samples first, or raise the setting",
    };
    if (status < 0 || (size_t)status >= sizeof texts / sizeof texts[0])
        return "this number is no status of the library";
    return texts[status];
}

const char *fr_version(void)
{
    return FR_DOTTED(FR_VERSION_MAJOR, FR_VERSION_MINOR, FR_VERSION_PATCH);
}

size_t fr_real_size(void)
{
    return sizeof(fr_real);
}

fr_status fr_place(void *memory, size_t size, const void *config, const void *out, size_t needed,
                   uint32_t magic)
{
    fr_head head = {0u, FR_SAVED_BY, FR_STATE_RUNNING};
    if (memory == NULL || config == NULL || out == NULL)
        return FR_NULL_POINTER;
    if (needed == 0u)
        return FR_BAD_CONFIG;
    if ((uintptr_t)memory % FR_ALIGNMENT != 0u)
        return FR_MISALIGNED;
    if (size < needed)
        return FR_TOO_SMALL;
    (void)memset(memory, 0, needed);
    head.magic = magic;
    (void)memcpy(memory, &head, sizeof head);
    return FR_OK;
}

fr_status fr_ready(const void *object, uint32_t magic)
{
    fr_head head;
    if (object == NULL)
        return FR_NULL_POINTER;
    if ((uintptr_t)object % FR_ALIGNMENT != 0u)
        return FR_MISALIGNED;
    (void)memcpy(&head, object, sizeof head);
    if (head.magic != magic || head.version != FR_SAVED_BY)
        return FR_BAD_OBJECT;
    return head.state == FR_STATE_RUNNING ? FR_OK : FR_WRONG_ORDER;
}

fr_status fr_readable(const void *object, uint32_t magic)
{
    fr_status status = fr_ready(object, magic);
    return status == FR_WRONG_ORDER ? FR_OK : status;
}

fr_status fr_room(size_t count, const void *y, size_t capacity, size_t *written)
{
    if (written == NULL || (count > 0u && y == NULL))
        return FR_NULL_POINTER;
    *written = 0u;
    if (count > FR_MOST_SAMPLES)
        return FR_TOO_MANY;
    if (count > capacity) {
        *written = count;
        return FR_OUTPUT_FULL;
    }
    return FR_OK;
}
