/* The card reader, punch and typewriter of an IBM 1620, for a program that hull1620 translated to C. License: CC0 1.0.

   usage: PROGRAM [-s SWITCHES] [-a FILE] [-d FILE] < cards > punched

   -s SWITCHES  turn on sense switches, for example -s 13
   -a FILE      take the lines that ACCEPT reads from FILE
   -d FILE      write a line to FILE for each decision (IF, computed GO TO, end of a DO): card, outcome and value

   PRINT and TYPE write to standard error. Every punched record has at most 72 columns and every typed line 87.
   The code is C11 and C++. Compile with -Dreal=TYPE for another type of floating-point numbers; value_of(x) converts a
   number to double, and logged_value(x) is the number that -d writes for an IF. */
#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifndef real
#define real double
#define value_of(x) (x)
#endif
#ifndef logged_value
#define logged_value(x) value_of(x)
#endif

typedef int64_t integer;

/* Numbers that no statement has defined: their sums and products are recognized too. */
#define undefined_integer INT64_C(1000000000000000)
#define undefined_real NAN

enum { READ_CARDS, ACCEPT_LINES, PUNCH_CARDS, TYPE_LINES };
enum { LONGEST = 1000, DIGITS = 100 };

static FILE *decision_file, *line_file;
static int is_on[5];
static int first_read, cards_read;
/* The input or output statement in progress: its FORMAT, the position in it, its record and the card of the program. */
static int device, place, column, columns_written;
static char *layout;
static size_t position;
static int repeated_from;
static char record[LONGEST + 1];

static inline void refuse(int card, const char *text, ...) {
    va_list values;
    va_start(values, text);
    fflush(stdout);
    fprintf(stderr, card ? "%s: card %d: " : "%s: ", source_name, card);
    vfprintf(stderr, text, values);
    fputc('\n', stderr);
    va_end(values);
    exit(2);
}

static inline void finish_run(void) {
    if (fflush(stdout)) refuse(0, "cannot write standard output");
    exit(0);
}

static inline FILE *opened(const char *name, const char *mode) {
    FILE *file = fopen(name, mode);
    if (!file) refuse(0, "cannot open %s", name);
    return file;
}

static inline void start(int count, char **arguments) {
    for (int k = 1; k < count; k++) {
        if (k + 1 == count || arguments[k][0] != '-' || !strchr("sad", arguments[k][1]) || arguments[k][2])
            refuse(0, "expected [-s SWITCHES] [-a FILE] [-d FILE], found %s", arguments[k]);
        char option = arguments[k++][1];
        if (option == 'a') line_file = opened(arguments[k], "r");
        else if (option == 'd') decision_file = opened(arguments[k], "w");
        else
            for (char *c = arguments[k]; *c; c++) {
                if (*c < '1' || *c > '4') refuse(0, "sense switches are 1 to 4, found %s", arguments[k]);
                is_on[*c - '0'] = 1;
            }
    }
}

/* Decisions. Each function returns the branch that the program takes. */

static inline void record_decision(int card, int outcome, double value) {
    if (decision_file) fprintf(decision_file, "%d %d %.17g\n", card, outcome, value);
}

static inline int sign_of(int card, real value) {
    if (value != value) refuse(card, "the sign of an undefined number decides a branch");
    int outcome = (value > 0) - (value < 0);
    record_decision(card, outcome, logged_value(value));
    return outcome;
}

static inline integer defined(int card, integer value) {
    if (value > 100000000 || value < -100000000) refuse(card, "an undefined integer is used");
    return value;
}

static inline int integer_sign_of(int card, integer value) {
    value = defined(card, value);
    int outcome = (value > 0) - (value < 0);
    record_decision(card, outcome, (double)value);
    return outcome;
}

static inline int choice_of(int card, integer value, int labels) {
    value = defined(card, value);
    if (value < 1 || value > labels) refuse(card, "the value %" PRId64 " of a computed GO TO selects no statement number", value);
    record_decision(card, (int)value, (double)value);
    return (int)value;
}

/* Step the variable of a DO, and return 1 if it does not exceed the limit. */
static inline int is_repeated(int card, integer *variable, integer step, integer last) {
    *variable = defined(card, *variable) + defined(card, step);
    *variable %= 10000;
    int outcome = *variable <= defined(card, last);
    record_decision(card, outcome, (double)*variable);
    return outcome;
}

static inline int switch_is_on(int number) {
    if (number < 9) return is_on[number];
    /* Switch 9 is the indicator of the last card. Testing it turns it off. */
    static int tested_at;
    int next = getchar();
    if (next != EOF) ungetc(next, stdin);
    int outcome = next == EOF && cards_read > tested_at;
    if (outcome) tested_at = cards_read;
    return outcome;
}

/* Fixed-point numbers have four digits. */

static inline integer four_digits(int card, integer value) { return defined(card, value) % 10000; }

static inline integer quotient(int card, integer dividend, integer divisor) {
    return defined(card, divisor) == 0 ? 9999 : defined(card, dividend) / divisor;
}

static inline integer fixed_of(int card, real value) {
    double size = fabs(value_of(value));
    if (!(size < INFINITY)) refuse(card, "no integer corresponds to an infinite or undefined number");
    integer digits = (integer)fmod(floor(size), 10000.0);
    return value < 0 ? -digits : digits;
}

static inline real float_of(int card, integer value) { return (double)defined(card, value); }

static inline integer index_of(int card, integer subscript, integer size) {
    if (subscript < 1 || subscript > size) refuse(card, "subscript %" PRId64 " is outside an array of %" PRId64 " elements", subscript, size);
    return subscript - 1;
}

/* A statement that only copies a field may copy element N+1 of an array, which is always undefined. */
static inline integer copied_of(int card, integer subscript, integer size) {
    return subscript == size + 1 ? size : index_of(card, subscript, size);
}

/* Floating-point functions of the 1620's library, which accept a negative argument. */

static inline real squared(real x) { return x * x; }
static inline real sqrt_of(real x) { return sqrt(fabs(x)); }
static inline real log_of(real x) { return log(fabs(x)); }
static inline real sin_of(real x) { return sin(x); }
static inline real cos_of(real x) { return cos(x); }
static inline real atan_of(real x) { return atan(x); }
static inline real exp_of(real x) { return exp(x); }
static inline real power_of(real base, real exponent) { return pow(fabs(base), exponent); }

static inline real integer_power_of(real base, integer count) {
    if (base == 0 && count < 0) return INFINITY;
    real size = pow(fabs(base), (real)(double)count);
    return base < 0 && count % 2 ? -size : size;
}

static inline void pause_at(int card, int number) {
    fprintf(stderr, "%s: card %d: PAUSE %d: the operator presses START\n", source_name, card, number);
}

#define undefine(array, value) for (size_t k = 0; k < sizeof array / sizeof *array; k++) array[k] = value

/* Records. */

static inline void end_record(void) {
    if (device == READ_CARDS || device == ACCEPT_LINES) {
        FILE *file = device == READ_CARDS ? stdin : line_file;
        if (!file) refuse(place, "ACCEPT needs a file of typed lines (-a FILE)");
        char line[LONGEST];
        if (!fgets(line, LONGEST, file)) refuse(place, "the %s ended in the middle of a data set", device ? "typed lines" : "deck");
        line[strcspn(line, "\r\n")] = 0;
        snprintf(record, sizeof record, "%-80.80s", line);
        column = 0;
        cards_read += device == READ_CARDS;
        return;
    }
    int room = device == PUNCH_CARDS ? 72 : 87;
    record[columns_written] = 0;
    if (device == TYPE_LINES) record[strcspn(record, "|?")] = 0;
    if ((int)strlen(record) > room) record[room] = 0;
    size_t length = strlen(record);
    while (length && record[length - 1] == ' ') record[--length] = 0;
    fprintf(device == PUNCH_CARDS ? stdout : stderr, "%s\n", record);
    columns_written = 0;
}

static inline void write_columns(const char *columns, int width) {
    if (columns_written + width > LONGEST) refuse(place, "a record of more than %d columns", LONGEST);
    memcpy(record + columns_written, columns, width);
    columns_written += width;
}

static inline void begin_list(int card, int unit, char *format, int again) {
    device = unit, place = card, layout = format, position = 0, repeated_from = again, columns_written = 0;
    if (unit == READ_CARDS) {
        /* An empty hopper ends the run at the READ that begins a data set, which is the first one executed. */
        int begins = !first_read || first_read == card || every_read_ends;
        if (!first_read) first_read = card;
        int next = getchar();
        if (next == EOF && cards_read && begins) finish_run();
        if (next == EOF && !cards_read) refuse(card, "the hopper is empty at the first READ");
        if (next != EOF) ungetc(next, stdin);
    }
    if (unit == READ_CARDS || unit == ACCEPT_LINES) end_record();
}

/* Process literals and slashes of the FORMAT up to the next field. Return 0 at its end. */
static inline int reaches_field(void) {
    for (;;) {
        char *rest = layout + position, *end;
        if (!*rest) return 0;
        if (*rest == ',' || *rest == '/') {
            if (*rest == '/') end_record();
            position++;
            continue;
        }
        int width = (int)strtol(rest, &end, 10);
        if (end == rest) return 1;
        if (device == READ_CARDS || device == ACCEPT_LINES) {
            /* The columns of the card become the new text of an H field. */
            for (int k = 0; *end == 'H' && k < width; k++, column++) end[1 + k] = column < 80 ? record[column] : ' ';
            column += *end == 'X' ? width : 0;
        } else
            for (int k = 0; k < width; k++) write_columns(*end == 'H' ? end + 1 + k : " ", 1);
        position = end - layout + 1 + (*end == 'H' ? width : 0);
    }
}

static inline void end_list(void) {
    reaches_field();
    if (device == PUNCH_CARDS || device == TYPE_LINES) end_record();
}

static inline char next_field(int is_fixed, int *width, int *decimals) {
    if (!reaches_field()) {
        if (repeated_from < 0) refuse(place, "the FORMAT has no field for the numbers in the list");
        end_record();
        position = repeated_from;
        reaches_field();
    }
    char *end, letter = layout[position];
    *width = (int)strtol(layout + position + 1, &end, 10);
    *decimals = *end == '.' ? (int)strtol(end + 1, &end, 10) : 0;
    position = end - layout;
    if ((letter == 'I') != is_fixed) refuse(place, "the field %c%d does not have the mode of its number", letter, *width);
    return letter;
}

/* Move the number in a field to its left end and resolve its blanks. Return its length. */
static inline int squeezed(char *field, int width) {
    int first = 0, end = width, point = width, first_e = width, last_e = -1, blanks = 0, drop = 0, length = 0;
    while (first < width && field[first] == ' ') first++;
    while (end > first && field[end - 1] == ' ') end--;
    if (first == end) return 0;
    for (int k = first; k < end; k++) {
        blanks += field[k] == ' ';
        if (field[k] == '.' && point == width) point = k;
        if (field[k] == 'E' || (k > first && strchr("+-", field[k]))) {
            last_e = k;
            if (first_e == width) first_e = k;
        }
    }
    if (point < width || last_e >= 0) {
        /* A blank after the first exponent mark, or between the point and the last one, may belong to the exponent. */
        for (int k = first; k < end; k++) drop |= field[k] == ' ' && (k > first_e || (point < k && k < last_e));
    } else if (blanks || end < width)
        end = width;
    for (int k = first; k < end; k++)
        if (field[k] != ' ' || !drop) field[length++] = field[k] == ' ' ? '0' : field[k];
    field[length] = 0;
    return length;
}

static inline void get_field(int is_fixed, char *field, int *decimals) {
    int width;
    next_field(is_fixed, &width, decimals);
    for (int k = 0; k < width; k++, column++) field[k] = column < 80 ? record[column] : ' ';
    field[width] = 0;
    if (!squeezed(field, width)) *field = 0;
}

#define is_digit(c) ((c) >= '0' && (c) <= '9')

static inline int no_number(const char *field) {
    refuse(place, "card or line %d of the data: '%s' is not a number in range", cards_read, field);
    return 0;
}

static inline void get_integer(integer *target) {
    char field[LONGEST + 1], *c = field;
    int decimals;
    get_field(1, field, &decimals);
    int is_negative = *c == '-';
    integer value = 0;
    c += *c == '-' || *c == '+';
    if (*field && !*c) no_number(field);
    for (; *c; c++) value = is_digit(*c) ? (10 * value + *c - '0') % 10000 : no_number(field);
    *target = is_negative ? -value : value;
}

static inline void get_real(real *target) {
    char field[LONGEST + 1], digits[LONGEST + 20], *c = field;
    int decimals, scale = -1, lead = 0, length = 1, any = 0;
    get_field(0, field, &decimals);
    digits[0] = *c == '-' ? '-' : '+';
    c += *c == '-' || *c == '+';
    for (; is_digit(*c) || (*c == '.' && scale < 0); c++) {
        if (*c == '.') { scale = 0; continue; }
        any = 1;
        scale += scale >= 0;
        lead += lead || *c != '0';
        digits[length++] = *c;
    }
    /* A point on the card overrides the decimals of the FORMAT. The exponent may omit its E if it has a sign. */
    if (scale < 0) scale = decimals;
    long power = 0;
    if (*c) {
        char *start = c + (*c == 'E'), *end = start;
        if (*start == '+' || *start == '-') end++;
        if (*end && (start > c || end > start)) power = strtol(start, &end, 10);
        if (*end || !is_digit(end[-1])) no_number(field);
    }
    if (*field && !any) no_number(field);
    if (lead && (lead - scale + power < -99 || lead - scale + power > 99)) no_number(field);
    snprintf(digits + length, sizeof digits - length, "%sE%ld", length == 1 ? "0" : "", lead ? power - scale : 0);
    *target = strtod(digits, NULL);
}

/* Write the decimal digits of a number, those of the shortest decimal that reads back as the same number, without
   rounding. Return the exponent of a point before the first digit. */
static inline int digits_of(double value, int count, char *digits) {
    char text[40];
    int precision = 16, nines = count;
    snprintf(text, sizeof text, "%.16e", value);
    while (nines > 0 && nines < 15 && text[1 + nines] == '9') nines++;
    if (nines >= 15 || count > 14)
        for (precision = 0; precision < 17; precision++) {
            snprintf(text, sizeof text, "%.*e", precision, value);
            if (strtod(text, NULL) == value) break;
        }
    memset(digits, '0', DIGITS);
    digits[0] = text[0];
    for (int k = 1; k <= precision && text[1] == '.'; k++) digits[k] = text[1 + k];
    return value == 0 ? 0 : atoi(strchr(text, 'e') + 1) + 1;
}

static inline int e_field(char *text, int width, int decimals, double value) {
    char digits[DIGITS];
    int count = width >= 14 ? 8 : width - 6, left = count - decimals;
    if (count < 1 || left < 0) return 0;
    int exponent = digits_of(fabs(value), count, digits) - left, first = width - count - 5;
    if (value == 0) exponent = -99;
    if (exponent < -99 || exponent > 99) return 0;
    memset(text, ' ', width);
    if (signbit(value)) text[first - 1] = '-';
    memcpy(text + first, digits, left);
    text[first + left] = '.';
    memcpy(text + first + left + 1, digits + left, decimals);
    snprintf(text + width - 4, 5, "E%c%02d", exponent < 0 ? '-' : '+', abs(exponent) % 100);
    return 1;
}

static inline int f_field(char *text, int width, int decimals, double value) {
    char digits[DIGITS];
    int exponent = digits_of(fabs(value), DIGITS, digits), left = exponent > 0 ? exponent : 0;
    /* One column is reserved for the sign. */
    if (left + decimals + 2 > width) return 0;
    int point = width - decimals - 1;
    memset(text, ' ', width);
    memset(text + point - left, '0', left + 1 + decimals);
    text[point] = '.';
    if (signbit(value)) text[point - left - 1] = '-';
    for (int k = 0; k < 17 && exponent - 1 - k >= -decimals; k++) {
        int power = exponent - 1 - k;
        text[power >= 0 ? point - power - 1 : point - power] = digits[k];
    }
    return 1;
}

static inline void put_real(real number) {
    double value = value_of(number), size = fabs(value);
    char text[LONGEST + 1];
    int width, decimals;
    char letter = next_field(0, &width, &decimals);
    if (value != value) refuse(place, "an undefined number cannot be written");
    if (size >= 1e99 || (size > 0 && size < 1e-100)) refuse(place, "%g is out of a card's range, E-99 to E+99", value);
    if (!(letter == 'E' ? e_field : f_field)(text, width, decimals, value)) e_field(text, width = 14, 8, value);
    write_columns(text, width);
}

static inline void put_integer(integer value) {
    char text[LONGEST + 1], digits[24];
    int width, decimals;
    next_field(1, &width, &decimals);
    snprintf(digits, sizeof digits, "%" PRId64, defined(place, value) < 0 ? -value : value);
    /* High-order digits that do not fit are lost. Only a negative number needs a column for its sign. */
    int room = width - (value < 0), length = (int)strlen(digits), lost = length > room ? length - room : 0;
    memset(text, ' ', width);
    while (lost && lost < length && digits[lost] == '0') lost++;
    if (lost == length && room) lost--;
    memcpy(text + width - (length - lost), digits + lost, length - lost);
    if (value < 0) text[width - (length - lost) - 1] = '-';
    write_columns(text, width);
}
