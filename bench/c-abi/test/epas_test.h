/* The tests of the library from C: the same on the host and on the target. */
#ifndef EPAS_TEST_H
#define EPAS_TEST_H

#include "epas_friction.h"

/* Puts a text out. Each platform has its own. */
void test_put(const char *text);
void test_put_number(uint32_t number);

/* setups.c: the scenes, set up as a user would. Each returns the status. */
extern const epas_block_t test_block;
extern const epas_block_t test_worn_block;
extern const epas_block_t test_range_block;
extern const epas_block_t test_other_range_block;
extern const epas_block_t test_ball_block;
extern const epas_block_t test_worn_ball_block;
extern const epas_block_t test_ball_range_block;
extern const epas_closed_form_configuration_t test_closed_form_configuration;
extern const epas_screw_configuration_t test_screw_configuration;
extern const epas_screw_configuration_t test_worn_screw_configuration;
extern const epas_screw_range_configuration_t test_screw_range_configuration;
extern epas_linear_configuration_t test_linear_configuration;
extern const epas_memory_configuration_t test_memory_configuration;
extern epas_folded_ball_range_t test_ball_range;
extern epas_folded_ball_t test_spare_ball;
uint32_t test_setup_caged(epas_caged_t *place);
uint32_t test_setup_caged_range(epas_caged_range_t *place);
uint32_t test_setup_closed_form(epas_closed_form_t *place);
uint32_t test_setup_memory(epas_memory_t *place);
uint32_t test_setup_ball(void);
uint32_t test_setup_ball_range(void);
uint32_t test_setup_screw(epas_screw_t *place);
uint32_t test_setup_screw_range(epas_screw_range_t *place);
uint32_t test_setup_linear(epas_linear_t *place);

/* cases.c: one stored tick; 1 where a result differs from the stored one in a bit, else 0. */
extern const uint32_t test_ticks;
uint32_t test_caged_tick(epas_caged_t *place, uint32_t tick);
uint32_t test_memory_tick(epas_memory_t *place, uint32_t tick);
uint32_t test_screw_tick(epas_screw_t *place, uint32_t tick);
uint32_t test_linear_tick(epas_linear_t *place, uint32_t tick);

/* Every stored case; the number of those that differ. */
uint32_t test_cases(void);

/* refusals.c: what is refused, and how; the number of failed checks. */
uint32_t test_refusals(void);

/* changes.c: what is set while a model runs; the number of failed checks. */
uint32_t test_changes(void);

/* reaction.c: the README's example under a load beyond its limit, and without an input; the number of failed checks. */
uint32_t test_reaction(void);

#endif
