/* SPDX-License-Identifier: Apache-2.0
 *
 * What a Python program under callgrind calls: count from here, stop, and write a part so named.
 */
#include <valgrind/callgrind.h>

void counted_start(void)
{
    CALLGRIND_START_INSTRUMENTATION;
}

void counted_stop(const char *name)
{
    CALLGRIND_STOP_INSTRUMENTATION;
    CALLGRIND_DUMP_STATS_AT(name);
}
