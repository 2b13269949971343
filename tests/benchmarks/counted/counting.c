/* SPDX-License-Identifier: Apache-2.0
 *
 * Run stages under valgrind's callgrind, which counts the instructions between two readings of the
 * clock of the harness, that is, those of each push. Called with the names of stages; each runs
 * twice, as long as FEWER and MORE. callgrind writes a part for each line of costs, named by it.
 */
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

#include <valgrind/callgrind.h>

#include "board.h"
#include "counting.h"

enum { FEWER = 20, MORE = 60 };

void (*counted_stage)(void);
int counted_pieces;

static const char *name;
static char line[256];

uint32_t board_ticks(void)
{
    CALLGRIND_TOGGLE_COLLECT;
    return 0u;
}

/* Lines of costs become names of parts; lines of bits are not needed, others are problems. */
void board_put(const char *text)
{
    (void)strncat(line, text, sizeof line - strlen(line) - 1u);
    if (strchr(text, '\n') == NULL)
        return;
    if (strncmp(line, "rate ", 5u) == 0) {
        char title[sizeof line + 64u];
        (void)snprintf(title, sizeof title, "%s %s", name, line);
        *strchr(title, '\n') = '\0';
        CALLGRIND_DUMP_STATS_AT(title);
    } else if (strncmp(line, "bits", 4u) != 0) {
        (void)printf("%s: %s", name, line);
    }
    line[0] = '\0';
}

int main(int count, char **names)
{
    static const int lengths[] = {FEWER, MORE};
    void *program = dlopen(NULL, RTLD_NOW);
    for (int k = 1; k < count; k++) {
        char symbol[128] = "stage_";
        name = names[k];
        (void)strncat(symbol, name, sizeof symbol - 8u);
        *(void **)&counted_stage = dlsym(program, symbol);
        if (counted_stage == NULL) {
            (void)printf("%s: no such stage\n", name);
            return 1;
        }
        for (int i = 0; i < 2; i++) {
            counted_pieces = lengths[i];
            measure();
        }
    }
    return 0;
}
