/* Texts and the exit through the debugger, or QEMU. */
#include "board.h"
#include "epas_test.h"

#define SYS_WRITE0 0x04u
#define SYS_EXIT 0x18u
#define APPLICATION_EXIT 0x20026u
#define RUN_TIME_ERROR 0x20023u

static void semihosting(uint32_t operation, uint32_t argument)
{
    register uint32_t r0 __asm("r0") = operation;
    register uint32_t r1 __asm("r1") = argument;

    __asm volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
}

void test_put(const char *text)
{
    semihosting(SYS_WRITE0, (uint32_t)text);
}

void test_put_number(uint32_t number)
{
    char digits[11];
    uint32_t place = sizeof(digits) - 1u;

    digits[place] = '\0';
    do {
        place--;
        digits[place] = (char)('0' + (char)(number % 10u));
        number /= 10u;
    } while (number != 0u);
    test_put(&digits[place]);
}

void board_exit(uint32_t passed)
{
    for (;;) {
        semihosting(SYS_EXIT, (passed != 0u) ? APPLICATION_EXIT : RUN_TIME_ERROR);
    }
}
