/* The least that speaks the protocol: a device that leaves every recording out. */
#include <stddef.h>

#include "protocol.h"

int main(void)
{
    struct device device = {"hello", "0.1", "temporal", NULL, "there is no pipeline yet"};
    return serve(&device);
}
