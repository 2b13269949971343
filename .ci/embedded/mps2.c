/* SPDX-License-Identifier: Apache-2.0
 *
 * Start-up of a Cortex-M on the boards mps2-an386 and mps2-an500 as QEMU emulates them, with the
 * output of semihosting and the first timer of the board, whose 32 bits last for 170,000 million
 * instructions; SysTick has 24. With `-icount shift=0` an instruction takes 1 ns, so a tick of the
 * 25 MHz clock is 40 instructions.
 */
#include "board.h"

#define WRITE0 0x04u
#define EXIT 0x18u
#define APPLICATION_EXIT 0x20026u
#define FAULT 0x20023u
#define PAINT 0xA5A5A5A5u

extern uint32_t image_painted[], image_stack[], image_data_from[], image_data[], image_data_end[];
extern uint32_t image_bss[], image_bss_end[];

static volatile uint32_t *const timer = (volatile uint32_t *)0x40000000u;
static volatile uint32_t *const coprocessors = (volatile uint32_t *)0xE000ED88u;

static void host_call(uint32_t operation, uintptr_t argument)
{
    register uint32_t r0 __asm__("r0") = operation;
    register uintptr_t r1 __asm__("r1") = argument;
    __asm__ volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
}

void board_put(const char *text)
{
    host_call(WRITE0, (uintptr_t)text);
}

uint32_t board_ticks(void)
{
    return timer[1];
}

static void stop_at_fault(void)
{
    board_put("fault\n");
    host_call(EXIT, FAULT);
}

/* Write a pattern over the stack below the caller, and say how many bytes of it are written over. */
static void paint(void)
{
    uint32_t *end = (uint32_t *)__builtin_frame_address(0) - 16;
    for (volatile uint32_t *word = image_painted; word < end; word++)
        *word = PAINT;
}

static void put_painted(void)
{
    const uint32_t *word = image_painted;
    while (*word == PAINT)
        word++;
    board_put("stack ");
    board_put_number((uint64_t)((uintptr_t)image_stack - (uintptr_t)word));
    board_put("\n");
}

static void start(void)
{
    const uint32_t *from = image_data_from;
    for (uint32_t *to = image_data; to < image_data_end; to++)
        *to = *from++;
    for (uint32_t *to = image_bss; to < image_bss_end; to++)
        *to = 0u;
    *coprocessors |= 0xFu << 20; /* the floating-point unit */
    __asm__ volatile("dsb\n\tisb");
    timer[2] = 0xFFFFFFFFu; /* from where it starts again */
    timer[1] = 0xFFFFFFFFu;
    timer[0] = 1u; /* on, without an interrupt */
    paint();
    measure();
    put_painted();
    host_call(EXIT, APPLICATION_EXIT);
}

__attribute__((section(".vectors"), used)) static void *const vectors[] = {
    image_stack, (void *)start, (void *)stop_at_fault, (void *)stop_at_fault,
    (void *)stop_at_fault, (void *)stop_at_fault, (void *)stop_at_fault,
};
