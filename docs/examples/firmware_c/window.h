/* Float64 files through a window. */
#ifndef WINDOW_H
#define WINDOW_H

#include "channel.h"

bool window_open(struct window *window, const char *folder, const char *name,
                 struct failure *failure);
void window_close(struct window *window);

/* Sample `index`, which has to be within the file; NaN if the file cannot be read there. */
double window_at(struct window *window, long index);

#endif
