/* The firmware as a device of the judge. */
#include <stddef.h>

#include "protocol.h"
#include "run.h"

int main(void)
{
    struct device device = {"firmware_c", "2.0", "temporal", run, NULL, NULL};
    return serve(&device);
}
