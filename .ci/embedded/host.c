/* SPDX-License-Identifier: Apache-2.0
 *
 * The same program on the host, for the numbers alone.
 */
#include <stdio.h>

#include "board.h"

uint32_t board_ticks(void)
{
    return 0u;
}

void board_put(const char *text)
{
    (void)fputs(text, stdout);
}

int main(void)
{
    measure();
    return 0;
}
