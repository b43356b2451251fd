// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// MeshLab 2020.09 makes a filter's dialog as high as its number of parameters needs, with the button that runs the
// filter at the bottom, beyond the edge of a lower screen. This class adds a scroll bar there, and else the missing
// height.

#include <QObject>

class ScrollingDialogs : public QObject {
public:
    /// Handles dialogs of this application whose titles begin with `title`, while the object lives.
    ScrollingDialogs(const QString& title, QObject* parent);

    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    QString title_;
};
