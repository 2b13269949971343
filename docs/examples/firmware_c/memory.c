#include "memory.h"

#include <stdlib.h>

/* A piece with what follows it; its bytes begin behind, aligned for any object. */
struct piece {
    struct piece *next;
    double bytes[];
};

static struct piece *pieces;

void *run_memory(size_t size)
{
    struct piece *piece = size > 0 && size < SIZE_MAX / 2 ? calloc(1, sizeof *piece + size) : NULL;
    if (piece == NULL)
        return NULL;
    piece->next = pieces;
    pieces = piece;
    return piece->bytes;
}

void memory_release(void)
{
    while (pieces != NULL) {
        struct piece *next = pieces->next;
        free(pieces);
        pieces = next;
    }
}
