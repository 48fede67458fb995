/* The tests on the host. */
#include "epas_test.h"

#include <stdio.h>

void test_put(const char *text)
{
    (void)fputs(text, stdout);
}

void test_put_number(uint32_t number)
{
    (void)printf("%lu", (unsigned long)number);
}

int main(void)
{
    const uint32_t wrong = test_cases() + test_refusals() + test_changes() + test_reaction();

    return (wrong == 0u) ? 0 : 1;
}
