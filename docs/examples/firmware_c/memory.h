/* Memory of one run: the firmware places its objects in it, and the bench its points. */
#ifndef MEMORY_H
#define MEMORY_H

#include "firmware.h"

/* Give all of it back. */
void memory_release(void);

#endif
