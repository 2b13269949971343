/* The simplest program with the protocol: a device that skips every recording. */
#include <stddef.h>

#include "protocol.h"

int main(void)
{
    struct device device = {"hello", "0.1", "temporal", NULL, "there is no pipeline yet", NULL};
    return serve(&device);
}
