#!/usr/bin/env Rscript
# Computes the numbers of a validity report again, by base R alone.
#
#   Rscript validity.R FOLDER [RESULT.csv]
#
# FOLDER holds two tables:
#   sessions.csv  session, participant, experience (novice, intermediate, expert), arm, phase (pre, training,
#                 post, retention), attempt (from 1; 0 or empty: not known), then a column per measure
#   ratings.csv   rater, session, item, kind (scale: 1 to 5; check: 0 or 1), value
# Writes rows "result,measure,statistic,value" to RESULT.csv, or prints them. docs/validity.md says what they mean.
# The bootstrap's intervals differ from those of the report by what chance does: each draws for itself.

arguments <- commandArgs(trailingOnly = TRUE)
if (length(arguments) < 1 || length(arguments) > 2) {
  cat("usage: Rscript validity.R FOLDER [RESULT.csv]\n", file = stderr())
  quit(status = 2)
}
folder <- arguments[1]

min_persons <- 3
min_bootstrap_group <- 5
bootstrap_samples <- 10000
set.seed(1)

read_table <- function(name) {
  read.csv(file.path(folder, name), colClasses = "character", check.names = FALSE, na.strings = character(0),
           encoding = "UTF-8")
}
sessions <- read_table("sessions.csv")
ratings <- read_table("ratings.csv")
ratings$value <- as.numeric(ratings$value)
measures <- setdiff(names(sessions), c("session", "participant", "experience", "arm", "phase", "attempt"))
for (measure in measures) sessions[[measure]] <- suppressWarnings(as.numeric(sessions[[measure]]))
if (is.null(sessions$attempt)) sessions$attempt <- "0"
sessions$attempt <- ifelse(sessions$attempt == "", 0, suppressWarnings(as.numeric(sessions$attempt)))

# Equal values do not spread; sd() may find what rounding makes of them.
all_equal <- function(values) length(unique(values)) < 2
spread <- function(values) if (all_equal(values)) 0 else sd(values)

rows <- list()
put <- function(result, measure, ...) {
  values <- list(...)
  for (statistic in names(values)) {
    value <- unname(values[[statistic]])
    if (length(value) == 1 && is.finite(value))
      rows[[length(rows) + 1]] <<- list(result = result, measure = measure, statistic = statistic, value = value)
  }
}
put_interval <- function(result, measure, name, interval) {
  if (length(interval) == 2 && all(is.finite(interval)))
    for (i in 1:2) {
      value <- list(unname(interval[i]))
      names(value) <- paste0(name, c("_low", "_high")[i])
      do.call(put, c(list(result, measure), value))
    }
}
# Holm's p of all rows of a result with this statistic.
put_holm <- function(result, statistic) {
  found <- Filter(function(row) row$result == result && row$statistic == statistic, rows)
  if (length(found) == 0) return(invisible())
  adjusted <- p.adjust(sapply(found, function(row) row$value), "holm")
  for (i in seq_along(found)) {
    value <- list(adjusted[i])
    names(value) <- paste0(statistic, "_holm")
    do.call(put, c(list(result, found[[i]]$measure), value))
  }
}

# ---- raters

# A matrix of sessions by raters, NA where a rating is missing.
rating_matrix <- function(kind, item) {
  of_kind <- ratings[ratings$kind == kind, ]
  matrix <- matrix(NA_real_, length(unique(of_kind$session)), length(unique(of_kind$rater)),
                   dimnames = list(sort(unique(of_kind$session)), sort(unique(of_kind$rater))))
  of_item <- of_kind[of_kind$item == item, ]
  matrix[cbind(of_item$session, of_item$rater)] <- of_item$value
  matrix
}
scale_items <- unique(ratings$item[ratings$kind == "scale"])
check_items <- unique(ratings$item[ratings$kind == "check"])
scales <- lapply(scale_items, function(item) rating_matrix("scale", item))
total <- if (length(scales) > 0) Reduce(`+`, scales) else NULL

agreement <- function(name, table) {
  complete <- table[stats::complete.cases(table), , drop = FALSE]
  n <- nrow(complete)
  k <- ncol(complete)
  put("agreement", name, subjects = n, raters = k, dropped = nrow(table) - n)
  if (k < 2 || n < min_persons || all_equal(as.vector(complete))) return(invisible())
  long <- data.frame(value = as.vector(complete), subject = factor(rep(1:n, k)), rater = factor(rep(1:k, each = n)))
  squares <- summary(aov(value ~ subject + rater, data = long))[[1]][["Mean Sq"]]
  bms <- squares[1]
  jms <- squares[2]
  ems <- squares[3]
  of_one <- bms + (k - 1) * ems + k * (jms - ems) / n
  of_mean <- bms + (jms - ems) / n
  rounding <- 1e-12 * (bms + jms)
  if (min(of_one, of_mean) <= rounding) return(invisible())
  single <- (bms - ems) / of_one
  put("agreement", name, icc_single = single, icc_average = (bms - ems) / of_mean)
  if (ems <= rounding) return(invisible())
  # McGraw & Wong 1996, table 7, case 2A.
  a <- k * single / (n * (1 - single))
  b <- 1 + k * single * (n - 1) / (n * (1 - single))
  freedom <- (a * jms + b * ems)^2 / ((a * jms)^2 / (k - 1) + (b * ems)^2 / ((n - 1) * (k - 1)))
  above <- qf(0.975, n - 1, freedom)
  below <- qf(0.975, freedom, n - 1)
  low <- n * (bms - above * ems) / (above * (k * jms + (k * n - k - n) * ems) + n * bms)
  high <- n * (below * bms - ems) / (k * jms + (k * n - k - n) * ems + n * below * bms)
  # At its least value the ICC of one rater has no counterpart for the mean of k.
  least <- -1 / (k - 1)
  if (high <= least) return(invisible())
  put_interval("agreement", name, "icc_single", c(max(low, least), high))
  if (low > least) put_interval("agreement", name, "icc_average", k * c(low, high) / (1 + (k - 1) * c(low, high)))
}
for (i in seq_along(scale_items)) agreement(scale_items[i], scales[[i]])
if (!is.null(total)) agreement("raters_total", total)

# Variance of a function of subjects' weights by how it changes with each of them (infinitesimal jackknife).
influence_of <- function(statistic, n) {
  even <- rep(1 / n, n)
  step <- 1e-5
  sapply(1:n, function(i) {
    towards <- function(share) {
      weights <- (1 - share) * even
      weights[i] <- weights[i] + share
      statistic(weights)
    }
    (towards(step) - towards(-step)) / (2 * step)
  })
}

checklist <- function(name, table) {
  complete <- table[stats::complete.cases(table), , drop = FALSE]
  n <- nrow(complete)
  k <- ncol(complete)
  put("checklist", name, subjects = n, raters = k, dropped = nrow(table) - n)
  if (k < 2 || n < min_persons) return(invisible())
  observed_of <- function(w) sum(w * apply(complete, 1, function(r) {
    yes <- sum(r)
    (yes * (yes - 1) + (k - yes) * (k - yes - 1)) / (k * (k - 1))
  }))
  expected_of <- if (k == 2) {
    function(w) {
      yes <- colSums(w * complete)
      prod(yes) + prod(1 - yes)
    }
  } else {
    function(w) {
      yes <- sum(w * rowMeans(complete))
      yes^2 + (1 - yes)^2
    }
  }
  kappa_of <- function(w) 1 - (1 - observed_of(w)) / (1 - expected_of(w))
  even <- rep(1 / n, n)
  put("checklist", name, agreement = observed_of(even))
  if (1 - expected_of(even) < 1e-12) return(invisible())
  kappa <- kappa_of(even)
  put("checklist", name, kappa = kappa)
  influence <- influence_of(kappa_of, n)
  # Two raters: the multinomial's large-sample variance; more: over subjects, as Gwet's.
  variance <- if (k == 2) sum(influence^2) / n^2 else sum(influence^2) / (n * (n - 1))
  if (variance <= 1e-12) return(invisible())
  reach <- (if (k == 2) qnorm(0.975) else qt(0.975, n - 1)) * sqrt(variance)
  put_interval("checklist", name, "kappa", pmin(1, pmax(-1, kappa + c(-1, 1) * reach)))
}
for (item in check_items) checklist(item, rating_matrix("check", item))

if (!is.null(total)) {
  means <- rowMeans(total, na.rm = TRUE)
  sessions$raters_total <- means[match(sessions$session, names(means))]
  sessions$raters_total[is.nan(sessions$raters_total)] <- NA
  if (any(!is.na(sessions$raters_total))) measures <- c(measures, "raters_total")
}
measures <- measures[sapply(measures, function(measure) any(!is.na(sessions[[measure]])))]

# ---- persons

# One value per participant: the mean of those sessions that are asked for. To 12 digits, so that means of the same
# numbers in another order are equal, and so are ties among them.
person_means <- function(measure, which) {
  kept <- which & !is.na(sessions[[measure]])
  if (!any(kept)) return(setNames(numeric(0), character(0)))
  means <- tapply(sessions[[measure]][kept], sessions$participant[kept], mean)
  setNames(signif(as.vector(means), 12), names(means))
}

# What groups are compared by: values before a study has changed anything. Where sessions have phases, those of the
# phase pre; where none is of that phase, each participant's first session with a value, by attempt (not known: last),
# then in the order of the table. Without phases, all sessions.
group_means <- function(measure, experience) {
  which <- sessions$experience == experience & !is.na(sessions[[measure]])
  if (any(sessions$phase == "pre")) {
    which <- which & sessions$phase == "pre"
  } else if (any(sessions$phase != "")) {
    by_attempt <- order(ifelse(sessions$attempt > 0, sessions$attempt, Inf))
    found <- by_attempt[which[by_attempt]]
    which <- seq_along(which) %in% found[!duplicated(sessions$participant[found])]
  }
  person_means(measure, which)
}

# The non-centrality at which t is reached with chance p.
noncentrality <- function(t, freedom, p) {
  uniroot(function(shift) pt(t, freedom, shift) - p, c(t - 10 - abs(t), t + 10 + abs(t)), tol = 1e-10)$root
}

wilson <- function(hits, n) suppressWarnings(prop.test(hits, n, correct = FALSE)$conf.int)

area_by_pairs <- function(experts, novices) {
  outer(experts, novices, function(x, y) (x > y) + 0.5 * (x == y))
}

receiver <- function(measure, experts, novices) {
  result <- "known_groups"
  m <- length(experts)
  n <- length(novices)
  wins <- area_by_pairs(experts, novices)
  auc <- mean(wins)
  put(result, measure, auc = auc)
  variance <- var(rowMeans(wins)) / m + var(colMeans(wins)) / n
  if (variance > 1e-15) {
    put_interval(result, measure, "auc",
                 pmin(1, pmax(0, auc + c(-1, 1) * qnorm(0.975) * sqrt(variance))))
    if (min(m, n) >= min_bootstrap_group) {
      of_experts <- rmultinom(bootstrap_samples, m, rep(1, m)) / m
      of_novices <- rmultinom(bootstrap_samples, n, rep(1, n)) / n
      areas <- colSums(of_experts * (wins %*% of_novices))
      put_interval(result, measure, "auc_bootstrap", quantile(areas, c(0.025, 0.975)))
      put(result, measure, auc_bootstrap_sd = sd(areas))
    }
  }
  cuts <- sort(unique(c(experts, novices)))
  at_least <- auc >= 0.5
  hits <- sapply(cuts, function(cut) sum(if (at_least) experts >= cut else experts <= cut))
  rejected <- sapply(cuts, function(cut) sum(if (at_least) novices < cut else novices > cut))
  best <- which.max(hits * n + rejected * m)
  put(result, measure, threshold = cuts[best], experts_at_least = as.numeric(at_least),
      youden_j = hits[best] / m + rejected[best] / n - 1, sensitivity = hits[best] / m,
      specificity = rejected[best] / n)
  put_interval(result, measure, "sensitivity", wilson(hits[best], m))
  put_interval(result, measure, "specificity", wilson(rejected[best], n))
}

known_groups <- function(measure) {
  result <- "known_groups"
  experts <- group_means(measure, "expert")
  novices <- group_means(measure, "novice")
  put(result, measure, n_experts = length(experts), n_novices = length(novices))
  if (length(experts) >= min_persons) put(result, measure, mean_experts = mean(experts), sd_experts = spread(experts))
  if (length(novices) >= min_persons) put(result, measure, mean_novices = mean(novices), sd_novices = spread(novices))
  if (min(length(experts), length(novices)) < min_persons) return(invisible())
  m <- length(experts)
  n <- length(novices)
  if (spread(experts) + spread(novices) > 0) {
    welch <- t.test(experts, novices)
    put(result, measure, difference = mean(experts) - mean(novices), welch_p = welch$p.value)
    put_interval(result, measure, "difference", welch$conf.int)
    student <- t.test(experts, novices, var.equal = TRUE)
    t <- unname(student$statistic)
    freedom <- m + n - 2
    to_d <- sqrt(1 / m + 1 / n)
    j <- exp(lgamma(freedom / 2) - log(sqrt(freedom / 2)) - lgamma((freedom - 1) / 2))
    put(result, measure, cohens_d = t * to_d, hedges_g = j * t * to_d)
    if (abs(t) <= 37)
      put_interval(result, measure, "hedges_g", j * to_d * c(noncentrality(t, freedom, 0.975),
                                                             noncentrality(t, freedom, 0.025)))
  }
  if (!all_equal(c(experts, novices)))
    put(result, measure, mann_whitney_p = suppressWarnings(wilcox.test(experts, novices)$p.value))
  put(result, measure, cliffs_delta = mean(sign(outer(experts, novices, "-"))))
  receiver(measure, experts, novices)
}

benchmark <- function(measure) {
  experts <- sort(group_means(measure, "expert"))
  n <- length(experts)
  put("benchmarks", measure, n = n)
  if (n < min_persons) return(invisible())
  put("benchmarks", measure, mean = mean(experts), median = median(experts))
  if (!all_equal(experts)) put_interval("benchmarks", measure, "mean", t.test(experts)$conf.int)
  k <- qbinom(0.025, n, 0.5)
  if (k > 0 && pbinom(k, n, 0.5) <= 0.025) k <- k + 1
  if (k > 0) put_interval("benchmarks", measure, "median", experts[c(k, n + 1 - k)])
}

if (any(sessions$experience == "expert")) {
  for (measure in measures) known_groups(measure)
  put_holm("known_groups", "welch_p")
  put_holm("known_groups", "mann_whitney_p")
  for (measure in measures) benchmark(measure)
}

correlation <- function(measure) {
  both <- !is.na(sessions[[measure]]) & !is.na(sessions$raters_total)
  values <- person_means(measure, both)
  totals <- person_means("raters_total", both)
  put("correlations", measure, n = length(values))
  if (length(values) < 3 || all_equal(values) || all_equal(totals)) return(invisible())
  pearson <- cor.test(values, totals)
  put("correlations", measure, pearson = pearson$estimate, pearson_p = pearson$p.value)
  if (length(values) > 3) put_interval("correlations", measure, "pearson", pearson$conf.int)
  spearman <- cor.test(values, totals, method = "spearman", exact = FALSE)
  put("correlations", measure, spearman = spearman$estimate, spearman_p = spearman$p.value)
}
if ("raters_total" %in% measures) {
  for (measure in setdiff(measures, "raters_total")) correlation(measure)
  put_holm("correlations", "pearson_p")
  put_holm("correlations", "spearman_p")
}

# ---- trial

arms <- sort(unique(sessions$arm[sessions$arm != ""]), method = "radix")
later_phases <- Filter(function(phase) any(sessions$phase == phase & sessions$arm != ""), c("post", "retention"))

# Participants of an arm with a value in both phases.
pairs_of <- function(arm, phase, measure) {
  before <- person_means(measure, sessions$arm == arm & sessions$phase == "pre")
  after <- person_means(measure, sessions$arm == arm & sessions$phase == phase)
  both <- intersect(names(before), names(after))
  data.frame(before = unname(before[both]), after = unname(after[both]), arm = rep(arm, length(both)))
}

# After less before. Where they differ by rounding only, all are as the first.
gains_of <- function(pairs) {
  gains <- pairs$after - pairs$before
  if (length(gains) > 0 && diff(range(gains)) <= 1e-10 * max(abs(pairs$before), abs(pairs$after)))
    gains[] <- gains[1]
  gains
}

change <- function(arm, phase, measure) {
  result <- paste0("changes:", arm, ":", phase)
  pairs <- pairs_of(arm, phase, measure)
  put(result, measure, n = nrow(pairs))
  if (nrow(pairs) < min_persons || all_equal(gains_of(pairs))) return(invisible())
  test <- t.test(pairs$after, pairs$before, paired = TRUE)
  put(result, measure, change = test$estimate, paired_p = test$p.value)
  put_interval(result, measure, "change", test$conf.int)
}

arm_difference <- function(first, second, phase, measure) {
  result <- paste0("arm_differences:", first, "-", second, ":", phase)
  a <- pairs_of(first, phase, measure)
  b <- pairs_of(second, phase, measure)
  put(result, measure, n_first = nrow(a), n_second = nrow(b))
  if (min(nrow(a), nrow(b)) < min_persons) return(invisible())
  gain_a <- gains_of(a)
  gain_b <- gains_of(b)
  if (spread(gain_a) + spread(gain_b) > 0) {
    test <- t.test(gain_a, gain_b)
    put(result, measure, difference = mean(gain_a) - mean(gain_b), welch_p = test$p.value)
    put_interval(result, measure, "difference", test$conf.int)
  }
  if ((all_equal(a$before) && all_equal(b$before)) || (all_equal(a$after) && all_equal(b$after))) return(invisible())
  both <- rbind(a, b)
  fit <- lm(after ~ before + I(as.numeric(arm == first)), data = both)
  if (any(is.na(coef(fit)))) return(invisible())
  within_arms <- deviance(lm(after ~ arm, data = both))
  if (deviance(fit) <= 1e-12 * within_arms) return(invisible())
  row <- summary(fit)$coefficients[3, ]
  put(result, measure, ancova = row[1], ancova_p = row[4])
  put_interval(result, measure, "ancova", confint(fit)[3, ])
}

if (any(sessions$arm != "" & sessions$phase == "pre"))
  for (phase in later_phases) {
    for (arm in arms) {
      for (measure in measures) change(arm, phase, measure)
      put_holm(paste0("changes:", arm, ":", phase), "paired_p")
    }
    for (i in seq_along(arms)) for (j in seq_along(arms)) if (i < j) {
      for (measure in measures) arm_difference(arms[i], arms[j], phase, measure)
      for (statistic in c("welch_p", "ancova_p"))
        put_holm(paste0("arm_differences:", arms[i], "-", arms[j], ":", phase), statistic)
    }
  }

# ---- learning

curve_of <- deriv(~ plateau + (start - plateau) * exp(-rate * x), c("plateau", "start", "rate"),
                  function(plateau, start, rate, x) NULL)

# Of those who learn, without tests; attempts of which there are enough values.
learning <- function(measure) {
  kept <- sessions$attempt > 0 & !is.na(sessions[[measure]]) & sessions$experience != "expert" &
    !(sessions$phase %in% c("pre", "post", "retention"))
  by_attempt <- split(sessions[[measure]][kept], sessions$attempt[kept])
  means <- signif(vapply(Filter(function(values) length(values) >= min_persons, by_attempt), mean, 0), 12)
  put("learning", measure, attempts = length(means))
  if (length(means) < 5 || all_equal(means)) return(invisible())
  curve <- data.frame(y = as.vector(means), x = as.numeric(names(means)) - 1)
  # Starts from several rates; the fit with the least squares counts, unless a limit of the rates fits better.
  line_at <- function(rate) lm(y ~ exp(-rate * x), data = curve)
  fits <- lapply(c(0.03, 0.1, 0.3, 1, 2, 4), function(rate) {
    line <- line_at(rate)
    start <- list(plateau = unname(coef(line)[1]), start = sum(coef(line)), rate = rate)
    tryCatch(nls(y ~ curve_of(plateau, start, rate, x), data = curve, start = start,
                 control = nls.control(maxiter = 500, tol = 1e-8, minFactor = 1e-9)), error = function(e) NULL)
  })
  fits <- Filter(function(fit) !is.null(fit) && coef(fit)["rate"] > 0.01 && coef(fit)["rate"] < 5, fits)
  if (length(fits) == 0) return(invisible())
  fit <- fits[[which.min(sapply(fits, deviance))]]
  if (deviance(fit) >= min(deviance(line_at(0.01)), deviance(line_at(5)))) return(invisible())
  table <- summary(fit)$coefficients
  reach <- qt(0.975, nrow(curve) - 3) * table[, 2]
  if (table["rate", 1] <= reach["rate"]) return(invisible())
  for (name in rownames(table)) {
    value <- list(table[name, 1])
    names(value) <- name
    do.call(put, c(list("learning", measure), value))
    put_interval("learning", measure, name, table[name, 1] + c(-1, 1) * reach[name])
  }
}
if (any(sessions$attempt > 0)) for (measure in measures) learning(measure)

table <- data.frame(result = sapply(rows, `[[`, "result"), measure = sapply(rows, `[[`, "measure"),
                    statistic = sapply(rows, `[[`, "statistic"),
                    value = formatC(as.numeric(sapply(rows, `[[`, "value")), digits = 15, format = "g"))
write.csv(table, if (length(arguments) == 2) arguments[2] else stdout(), row.names = FALSE, quote = 1:3)
